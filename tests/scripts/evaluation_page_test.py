#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Clicks through the pages that sigloc-eval writes, in headless Chromium without a network.

    evaluation_page_test.py SIGLOC_EVAL SOURCE_FOLDER [PICTURE.png]

docs/images/evaluation.png is such a picture.
"""
import csv
import pathlib
import subprocess
import sys
import tempfile

from selenium import webdriver
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import Select

from run_page_test import browser, check, check_narrow, probability_texts, shown

OFFICE = ["--map", "maps/office.simplemap", "--rawlog", "rawlogs/office.rawlog"]
OFFICE += ["--ground-truth", "rawlogs/office-truth.txt"]
NARROW = ["--scans-in-map", "20", "--view", "120"]  # of which some fit several places


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def check_page_alone(path):
    page = path.read_text(encoding="utf-8")
    for outside in ("http:", "https:", "src=", "@import", "url("):
        check(outside not in page, f"the page has {outside}")


def listed(driver):
    return driver.find_elements(By.CSS_SELECTOR, "#list div")


def coloured_pixels(driver, canvas):
    """How many pixels of a canvas are neither white nor grey."""
    return driver.execute_script(
        """const canvas = arguments[0];
        const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
        let count = 0;
        for (let i = 0; i < pixels.length; i += 4)
          if (pixels[i + 3] > 200 && Math.abs(pixels[i] - pixels[i + 1]) > 60) ++count;
        return count;""",
        canvas,
    )


def check_probabilities(driver, out):
    """The probability of an ambiguous verdict is not that of its first pose."""
    rows = [row for row in rows_of(out / "results.csv") if row["method"] == "signature"]
    unsure = next(k for k, row in enumerate(rows) if row["verdict"] == "ambiguous")
    asked = ("signature", rows[unsure]["query"], "1")
    first = next(
        row for row in rows_of(out / "candidates.csv")
        if (row["method"], row["query"], row["rank"]) == asked
    )  # fmt: skip
    listed(driver)[unsure].click()
    facts = " ".join(shown(driver, "facts").split())
    for what, row in (("first pose", first), ("verdict", rows[unsure])):
        expected = [f"probability of the {what} {text}" for text in probability_texts(row["probability"])]
        check(any(text in facts for text in expected), f"none of {expected} in '{facts}'")


def check_relocation(driver, out):
    """Places, facts, filters, plots and tables are those of results.csv and report.md."""
    rows = [row for row in rows_of(out / "results.csv") if row["method"] == "signature"]
    names = [row.text for row in listed(driver)]
    check(names == [f"query {row['query']}" for row in rows], f"lists {names[:3]}")
    listed(driver)[2].click()
    check(shown(driver, "chosen").startswith(names[2] + ":"), shown(driver, "chosen"))
    check(rows[2]["verdict"] in shown(driver, "facts"), shown(driver, "facts"))
    check(coloured_pixels(driver, driver.find_element(By.ID, "map")) > 200, "no place is drawn")
    for plot in driver.find_elements(By.CSS_SELECTOR, "#plots canvas"):
        check(coloured_pixels(driver, plot) > 50, "a plot has no curve")
    counts = [
        int(label.text.rsplit(":", 1)[1])
        for label in driver.find_elements(By.CSS_SELECTOR, "#outcomes label")
    ]
    check(sum(counts) == len(rows), f"{counts} are not {len(rows)} queries")
    most = counts.index(max(counts))
    driver.find_element(By.ID, f"outcome-{most}").click()
    check(len(listed(driver)) == len(rows) - counts[most], "the filter does not hide")
    driver.find_element(By.ID, f"outcome-{most}").click()
    check(len(listed(driver)) == len(rows), "the filter does not show again")
    report = (out / "report.md").read_text(encoding="utf-8")
    head = next(line for line in report.splitlines() if line.startswith("| method"))
    cells = [cell.strip() for cell in head.strip("|").split("|")]
    shown_cells = [cell.text for cell in driver.find_elements(By.CSS_SELECTOR, "#text th")]
    check(shown_cells[: len(cells)] == cells, f"the table begins with {shown_cells[:4]}")


def check_methods(driver, names):
    method = Select(driver.find_element(By.ID, "method"))
    check([option.text for option in method.options] == names, "methods are missing")
    method.select_by_visible_text(names[-1])
    check(len(listed(driver)) > 0, f"{names[-1]} has no place")


def click_a_place(driver):
    """A click on the map chooses the place drawn there."""
    x, y, name = driver.execute_script(
        """const canvas = document.getElementById("map"), place = shownPlaces()[0];
        const at = placePose(place);
        return [(at[0] - view.x) * view.scale, -(at[1] - view.y) * view.scale, place.name];"""
    )
    driver.execute_script("choose(null)")
    click = webdriver.ActionChains(driver)
    canvas = driver.find_element(By.ID, "map")
    click.move_to_element_with_offset(canvas, round(x), round(y)).click().perform()
    check(shown(driver, "chosen") != "none chosen", f"a click on {name} chooses nothing")


def main():
    sigloc_eval, source = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        once, drives = pathlib.Path(folder) / "once", pathlib.Path(folder) / "drives"
        for data in ("maps", "rawlogs"):  # the page's title is the command: it names no one's folders
            (pathlib.Path(folder) / data).symlink_to(source / data)
        for arguments in (
            ["relocate", *OFFICE[:2], *NARROW, "--method", "signature,signature-anchors",
             "--out", once.name],
            ["track", *OFFICE, "--starts", "3", "--travel", "3", "--method", "signature",
             "--out", drives.name],
        ):  # fmt: skip
            subprocess.run([sigloc_eval, *arguments, "--quiet"], cwd=folder, check=True)
        driver = browser()
        try:
            for out, what in ((once, check_relocation), (drives, None)):
                check_page_alone(out / "report.html")
                driver.get((out / "report.html").as_uri())
                click_a_place(driver)
                if what:
                    what(driver, out)
                    if len(sys.argv) > 3:
                        driver.save_screenshot(sys.argv[3])
                    check_probabilities(driver, out)
                    check_methods(driver, ["signature", "signature-anchors"])
                check(listed(driver), "no place is listed")
            runs = rows_of(drives / "runs.csv")
            check(len(listed(driver)) == len(runs), "not every run is listed")
            check_narrow(driver)
            errors = [e["message"] for e in driver.get_log("browser") if e["level"] == "SEVERE"]
            check(not errors, f"the browser reports {errors}")
        finally:
            driver.quit()
    print("evaluation_page_test: places, plots and tables in order")


if __name__ == "__main__":
    main()
