#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Clicks through the page that sigloc-localize writes, in headless Chromium without a network.

    run_page_test.py SIGLOC_LOCALIZE SOURCE_FOLDER [PICTURE.png [PICTURE_OF_A_NARROW_WINDOW.png]]

docs/images/run.png is such a picture.
"""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait


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


def probability_texts(in_table):
    """How a page may show a probability, never rounded up; that of a table is rounded to six digits."""
    return [f"{math.floor(1000 * p) / 1000:.3f}" for p in (float(in_table) - 1e-6, float(in_table) + 1e-9)]


def check_step(driver, row, number, count):
    """The page shows what steps.csv has of a step."""
    check(shown(driver, "number") == f"{number} / {count}", f"shows {shown(driver, 'number')}")
    texts = probability_texts(row["first_pose_probability"])
    verdicts = [f"{row['verdict']} ({text})" for text in texts]
    check(shown(driver, "verdict") in verdicts, f"step {number}: {shown(driver, 'verdict')}, not {verdicts}")
    check(shown(driver, "reason") == row["reason"], f"step {number}: {shown(driver, 'reason')}")


def pixels_like(driver, color, width=None, height=None):
    """How many pixels of the map, or of its upper left corner, have about a colour of the page's."""
    return driver.execute_script(
        """const canvas = document.getElementById("map"), wanted = data.map.colors[arguments[0]];
        const part = k => parseInt(wanted.slice(1 + 2 * k, 3 + 2 * k), 16);
        const pixels = canvas.getContext("2d").getImageData(
            0, 0, arguments[1] || canvas.width, arguments[2] || canvas.height).data;
        let count = 0;
        for (let i = 0; i < pixels.length; i += 4)
          if ([0, 1, 2].every(k => Math.abs(pixels[i + k] - part(k)) < 16)) ++count;
        return count;""",
        color, width, height,
    )  # fmt: skip


def check_scan(driver):
    """Returns and features are drawn where the robot is sure to be: most returns are on walls."""
    driver.execute_script("show(0)")
    for what in ("returns", "observed"):
        check(pixels_like(driver, what) > 200, f"few {what} are drawn")
    meanings = shown(driver, "meanings")
    for what in ("returns", "features seen", "sure pose"):
        check(what in meanings, f"the legend has no {what}: {meanings}")
    # A hypothesis of weight w is sqrt(w) of the way along the legend's range of colours.
    range_of_colors = driver.find_element(By.CSS_SELECTOR, ".key.range").value_of_css_property("background-image")
    ends = driver.execute_script("return [weightColor(0), weightColor(1)]")
    check(range_of_colors == f"linear-gradient(to right, {ends[0]}, {ends[1]})", f"the legend has {range_of_colors}")
    check("truth" not in meanings, "the legend has a truth that is unknown")
    check("truth" not in shown(driver, "facts"), "the facts have a truth that is unknown")
    share = driver.execute_script(
        """const [x, y, phi] = steps[0].h[0], ends = steps[0].b, c = Math.cos(phi), s = Math.sin(phi);
        let near = 0;
        for (let k = 0; k < ends.length; k += 2) {
          const px = (x + (c * ends[k] - s * ends[k + 1]) / 100 - raster.x) / raster.pixel;
          const py = raster.height - (y + (s * ends[k] + c * ends[k + 1]) / 100 - raster.y) / raster.pixel;
          const around = image.getContext("2d").getImageData(px - 3, py - 3, 7, 7).data;
          let wall = false;
          for (let i = 0; i < around.length; i += 4) wall = wall || around[i] === raster.shades[2];
          if (wall) ++near;
        }
        return [near, ends.length / 2];"""
    )
    check(40 < share[1] <= 100 and share[0] > 0.8 * share[1], f"{share} returns are on walls")


def check_listed(driver, rows):
    """Above a table that lacks hypotheses stands how many there are."""
    held = driver.execute_script("return steps.map(step => step.a)")
    check(held == [int(row["hypotheses"]) for row in rows], f"numbers of hypotheses: {held}")
    driver.execute_script("show(0)")
    check(shown(driver, "listed") == "Hypotheses", f"of all: {shown(driver, 'listed')}")
    driver.execute_script("steps[0].a = 10; steps[0].h = Array(8).fill(steps[0].h[0]); show(0)")
    check(shown(driver, "listed") == "The 8 heaviest of 10 hypotheses", f"of some: {shown(driver, 'listed')}")


def check_left_out_scan(driver):
    """A long log's page has some of the scans: elsewhere it says so, and goes to the nearest."""
    driver.execute_script("show(5)")
    check("drawn at the first hypothesis" in shown(driver, "drawn"), f"of a scan: {shown(driver, 'drawn')}")
    nearest = driver.find_element(By.ID, "nearest")
    check(not nearest.is_displayed(), "a step with a scan shows the way to another")
    driver.execute_script("for (const k of [3, 4, 5]) { delete steps[k].f; delete steps[k].b; } show(4)")
    check("No scan is drawn" in shown(driver, "drawn"), f"without a scan: {shown(driver, 'drawn')}")
    check(pixels_like(driver, "returns") == 0, "a scan that is left out is drawn")
    nearest.click()
    check(shown(driver, "number").startswith("3 /"), f"the nearest scan is at {shown(driver, 'number')}")
    check(pixels_like(driver, "returns") > 200, "the nearest scan is not drawn")


def walk(driver, rows):
    count = len(rows)
    check_step(driver, rows[-1], count, count)  # the answer
    play = driver.find_element(By.ID, "play")
    play.click()
    WebDriverWait(driver, 10).until(lambda _: 1 < int(shown(driver, "number").split()[0]) < count)
    play.click()
    driver.find_element(By.ID, "slider").send_keys(Keys.HOME)
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
        check((pixels_like(driver, "not_localized", 300, 50) > 500) == has_banner, f"{verdict}: banner is wrong")


def check_narrow(driver, picture=None):
    """In a narrow window the parts are one below the other, and none is over another or cut."""
    driver.set_window_size(520, 900)
    overlaps = driver.execute_script(
        """const boxes = [...document.querySelectorAll("canvas, #controls > *, aside > *")]
             .filter(part => part.textContent || part.clientHeight > 0);
           const box = part => part.getBoundingClientRect();
           return boxes.flatMap((a, k) => boxes.slice(k + 1).filter(b =>
             box(a).right > box(b).left + 1 && box(b).right > box(a).left + 1 &&
             box(a).bottom > box(b).top + 1 && box(b).bottom > box(a).top + 1)
             .map(b => `${a.id || a.tagName} and ${b.id || b.tagName}`));"""
    )
    check(not overlaps, f"parts overlap: {overlaps}")
    inner, whole, wide = driver.execute_script(
        "return [window.innerWidth, document.documentElement.scrollWidth, get('map').clientWidth]"
    )
    check(inner < 700, f"the window is not narrow: {inner}")
    check(whole <= inner, f"the page is {whole} wide in a window of {inner}")
    check(wide > 0.9 * inner, f"the map is {wide} wide in a window of {inner}")
    if picture:
        driver.save_screenshot(picture)


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
            check_scan(driver)
            check_left_out_scan(driver)
            check_listed(driver, rows)
            driver.execute_script("show(Math.floor(steps.length / 2))")
            if len(sys.argv) > 3:
                driver.save_screenshot(sys.argv[3])
            check_narrow(driver, sys.argv[4] if len(sys.argv) > 4 else None)
            log = driver.get_log("browser")
            errors = [entry["message"] for entry in log if entry["level"] == "SEVERE"]
            check(not errors, f"the browser reports {errors}")
        finally:
            driver.quit()
    print(f"run_page_test: {len(rows)} steps in order")


if __name__ == "__main__":
    main()
