#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Clicks through the page that sigloc-localize writes, in headless Chromium without a network.

    run_page_test.py SIGLOC_LOCALIZE SOURCE_FOLDER [PICTURE.png]
"""
import csv
import pathlib
import subprocess
import sys
import tempfile

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys


def browser():
    options = webdriver.ChromeOptions()
    options.binary_location = "/usr/bin/chromium"
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1300,900",
                     "--host-resolver-rules=MAP * ~NOTFOUND"):  # fmt: skip
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)


def check(is_so, what):
    if not is_so:
        sys.exit(f"run_page_test: {what}")


def shown(driver, part):
    return driver.find_element(By.ID, part).text


def check_step(driver, row, number, count):
    """The page shows what steps.csv has of a step."""
    check(shown(driver, "number") == f"{number} / {count}", f"shows {shown(driver, 'number')}")
    verdict = f"{row['verdict']} ({float(row['first_pose_probability']):.3f})"
    check(shown(driver, "verdict") == verdict, f"step {number}: {shown(driver, 'verdict')}")
    check(shown(driver, "reason") == row["reason"], f"step {number}: {shown(driver, 'reason')}")


def red_pixels(driver):
    """How many pixels of the map's upper left corner have the colour of the banner."""
    return driver.execute_script(
        """const canvas = document.getElementById("map");
        const pixels = canvas.getContext("2d").getImageData(0, 0, 300, 50).data;
        let count = 0;
        for (let i = 0; i < pixels.length; i += 4)
          if (pixels[i] > 180 && pixels[i + 1] < 80 && pixels[i + 2] < 80) ++count;
        return count;"""
    )


def walk(driver, rows):
    count = len(rows)
    check_step(driver, rows[0], 1, count)
    driver.find_element(By.ID, "next").click()
    check_step(driver, rows[1], 2, count)
    driver.find_element(By.ID, "previous").click()
    check_step(driver, rows[0], 1, count)
    driver.find_element(By.TAG_NAME, "body").send_keys(Keys.ARROW_RIGHT)
    check_step(driver, rows[1], 2, count)
    driver.find_element(By.ID, "slider").send_keys(Keys.END)
    check_step(driver, rows[-1], count, count)
    strip = driver.find_element(By.ID, "strip")
    click = webdriver.ActionChains(driver)
    click.move_to_element_with_offset(strip, -strip.size["width"] // 2 + 2, 0).click().perform()
    check_step(driver, rows[0], 1, count)
    driver.find_element(By.ID, "times").click()
    check(abs(int(shown(driver, "number").split()[0]) - count / 2) < 3, "not in the middle")
    verdicts = [row["verdict"] for row in rows]
    check("localized" in verdicts and "ambiguous" in verdicts, "the log does not show both")
    for verdict, has_banner in (("localized", False), ("ambiguous", True)):
        number = next(k for k, row in enumerate(rows, 1) if row["verdict"] == verdict)
        driver.execute_script(f"show({number - 1})")
        check_step(driver, rows[number - 1], number, count)
        check((red_pixels(driver) > 500) == has_banner, f"{verdict}: banner is wrong")


def main():
    localize, source = sys.argv[1], pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "answer"
        # At its first scan the robot is localized with 0.998: it is to be unsure for a while.
        ini = pathlib.Path(folder) / "careful.ini"
        ini.write_text("[LocalizationExperiment]\n[sigloc.tracker]\nlocalized_probability = 0.9995\n", encoding="utf-8")
        subprocess.run(
            [localize, "--map", source / "maps/office.simplemap", "--log",
             source / "rawlogs/office.rawlog", "--out", out, "--quiet", ini],
            check=True, stdout=subprocess.DEVNULL, env={"XDG_CACHE_HOME": folder},
        )  # fmt: skip
        with open(out / "steps.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        page = (out / "report.html").read_text(encoding="utf-8")
        for outside in ("http:", "https:", "src=", "@import", "url("):
            check(outside not in page, f"the page has {outside}")
        driver = browser()
        try:
            driver.get((out / "report.html").as_uri())
            walk(driver, rows)
            if len(sys.argv) > 3:
                driver.save_screenshot(sys.argv[3])
            log = driver.get_log("browser")
            errors = [entry["message"] for entry in log if entry["level"] == "SEVERE"]
            check(not errors, f"the browser reports {errors}")
        finally:
            driver.quit()
    print(f"run_page_test: {len(rows)} steps in order")


if __name__ == "__main__":
    main()
