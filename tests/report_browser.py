"""The report in a browser: opens from disk without errors or requests, plays, scrubs, changes the case.

    python tests/report_browser.py [--binary planar-capture] [--pictures FOLDER]

needs tests/reference/requirements-reference.txt and Chromium, which PLANAR_CAPTURE_BROWSER may name.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

from playwright.sync_api import sync_playwright
from report_cases import VALUES, outward_impulses, own_values
from report_contacts import CHECKS, picture, scrub
from report_controls import use_controls
from report_numbers import numbers

ROOT = Path(__file__).resolve().parent.parent
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
QUIET = ("--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update")


def browser():
    """The browser's path; `None` for Playwright's own."""
    return os.environ.get("PLANAR_CAPTURE_BROWSER") or next(filter(None, map(shutil.which, BROWSERS)), None)


def use(page, file, pictures, check):
    """Uses one report as a reader would."""
    heard, asked = [], []
    page.on("console", lambda message: heard.append(message.text) if message.type in ("error", "warning") else None)
    page.on("pageerror", lambda error: heard.append(str(error)))
    page.on("request", lambda request: asked.append(request.url))
    page.goto(file.as_uri())
    cases = page.locator("#case option").count()
    assert page.locator(".plot canvas").count() >= 9 and cases >= 1
    start = picture(page)

    page.click("#play")
    page.wait_for_timeout(700)
    page.click("#play")
    played = float(page.input_value("#scrub"))
    assert played > 0.5, f"0.7 s of play at 5x came to {played} s"
    assert picture(page) != start, "nothing moved"
    still = page.input_value("#scrub")
    page.wait_for_timeout(200)
    assert page.input_value("#scrub") == still, "it goes on after pause"

    end = float(page.get_attribute("#scrub", "max"))
    for part in (0.25, 0.5, 0.99):
        scrub(page, part * end)
        assert f"{part * end:.2f} s" in page.inner_text("#clock"), page.inner_text("#clock")
        if pictures:
            page.screenshot(path=pictures / f"{file.parent.name}_{part}.png")
    page.keyboard.press("Escape")
    page.locator("h1").click()
    page.keyboard.press("ArrowLeft")
    assert float(page.input_value("#scrub")) < 0.99 * end

    page.locator(".plot .u-over").first.click(position={"x": 5, "y": 20})
    assert float(page.input_value("#scrub")) < 0.1 * end, "a click into a plot goes there"
    if cases > 1:
        before = page.inner_text("#own .impact")
        page.select_option("#case", index=cases - 1)
        assert page.inner_text("#own .impact") != before
    summary = json.loads((file.parent / "summary.json").read_text())
    if check:
        scenario = tomllib.loads((ROOT / "scenarios" / f"{file.parent.name}.toml").read_text())
        check(page, file.parent, summary, scenario)
    numbers(page, file.parent, summary)
    use_controls(page, file, pictures)
    assert not heard, heard
    assert not [url for url in asked if not url.startswith((file.as_uri(), "blob:"))], asked


def main():
    """Exit code 1 with the errors."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", type=Path, default=ROOT / "target" / "debug" / "planar-capture")
    parser.add_argument("--pictures", type=Path, help="where screenshots go")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=browser(), args=list(QUIET))
        for scenario, check in CHECKS.items():
            out = Path(folder) / scenario
            run = [options.binary, "run", ROOT / "scenarios" / f"{scenario}.toml", "--out", out, "--report"]
            subprocess.run(run, check=True, stdout=subprocess.DEVNULL)
            page = chromium.new_page(viewport={"width": 1400, "height": 950})
            use(page, out / "report.html", options.pictures, check)
            page.close()
            print(f"{scenario}: plays, scrubs, no error, no request", file=sys.stderr)
        outward_impulses(chromium, options.binary, Path(folder))
        own_values(chromium, options.binary, Path(folder), options.pictures)
        print(f"cases with values of their own beside others: {', '.join(VALUES)}", file=sys.stderr)
        chromium.close()


if __name__ == "__main__":
    main()
