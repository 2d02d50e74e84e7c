#!/usr/bin/python3
"""The live page in a real browser: Chromium without a window, driven by Selenium (./dev live-test).

usage: browser_test.py FANBEAM [FOLDER]   FOLDER keeps screenshots
"""
import os
import re
import subprocess
import sys
import time
import unittest

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

FANBEAM, FOLDER = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else None


def browser(width, height):
    options = Options()
    for word in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu",
                 "--hide-scrollbars", f"--window-size={width},{height}"):
        options.add_argument(word)
    options.binary_location = "/usr/bin/chromium"
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # A rate that leaves the machine to the browser too.
        cls.live = subprocess.Popen(
            [FANBEAM, "live", "--http", "0", "--rate", "5", "--rays-per-cell", "0.5"],
            stdout=subprocess.PIPE, text=True)
        cls.url = re.search(r"http://\S+", cls.live.stdout.readline()).group(0)
        cls.page = browser(1200, 900)

    @classmethod
    def tearDownClass(cls):
        cls.page.quit()
        cls.live.terminate()
        assert cls.live.wait(10) == 0, "a clean end"

    def setUp(self):
        self.page.set_window_size(1200, 900)
        self.page.get(self.url)
        self.wait(lambda: self.number() > 0, "a frame")

    def tearDown(self):
        told = [line for line in self.page.get_log("browser")]
        self.assertEqual(told, [], "nothing in the console")

    def wait(self, done, what):
        for _ in range(150):
            if done():
                return
            time.sleep(0.1)
        self.fail(f"no {what} within 15 s")

    def js(self, script, *arguments):
        return self.page.execute_script("return " + script, *arguments)

    def number(self):
        return int(self.js("document.body.dataset.frame || 0"))

    def keep(self, name):
        if FOLDER:
            os.makedirs(FOLDER, exist_ok=True)
            self.page.save_screenshot(os.path.join(FOLDER, name + ".png"))

    def mean(self):
        return self.js("state.frame.bscope.reduce((a, b) => a + b) / state.frame.bscope.length")

    def test_frames_arrive_in_order_whole_and_changing(self):
        self.page.execute_script(
            "window.seen = []; const before = take; take = buffer => { before(buffer);"
            " seen.push([state.frame.head.number, state.frame.bscope.length, state.frame.cscope.length,"
            " state.frame.bscope.reduce((a, b) => (a * 31 + b) | 0, 7)]); };")
        self.wait(lambda: self.js("seen.length") >= 10, "ten frames")
        seen = self.js("seen")
        numbers = [one[0] for one in seen]
        self.assertEqual(numbers, sorted(set(numbers)))
        self.assertEqual({(one[1], one[2]) for one in seen}, {(164 * 524, 164 * 524)})
        self.assertEqual(len({one[3] for one in seen}), len(seen))
        self.keep("live")

    def test_the_cursor_reads_what_is_under_it(self):
        ActionChains(self.page).send_keys("f").perform()  # freeze
        scope = self.page.find_element("id", "bscope")
        ActionChains(self.page).move_to_element_with_offset(scope, 40, -100).perform()
        told = self.page.find_element("id", "btold").text
        found = re.match(r"range (\d+) m, azimuth (\S+)°: grey (\d+), (\S+) dB", told)
        self.assertIsNotNone(found, told)
        x, y = self.js("state.cursor.bscope")
        row, column = int(y * 524), int(x * 164)
        grey = self.js("state.frame.bscope[arguments[0] * 164 + arguments[1]]", row, column)
        self.assertEqual(int(found.group(3)), grey)
        self.assertAlmostEqual(int(found.group(1)), 200 + (1 - y) * 524 * 6.67, delta=1.0)
        azimuth = float(found.group(2).replace("\u2212", "-"))
        self.assertAlmostEqual(azimuth, (x - 0.5) * 41.0, delta=0.06)
        decibel = float(found.group(4).replace("\u2212", "-"))
        self.assertAlmostEqual(decibel, -55 + grey / 255 * 60, delta=0.06)

    def test_the_cursor_tells_what_stands_there_as_the_layers_have_it(self):
        self.page.find_element("id", "freeze").click()
        scope = self.page.find_element("id", "bscope")
        told = {}
        for offset in (-150, -50, 50, 150):
            ActionChains(self.page).move_to_element_with_offset(scope, 10, offset).perform()
            x, y = self.js("state.cursor.bscope")
            cell = self.js("fetch(`/api/cell?scope=bscope&frame=${state.frame.head.number}&column=${arguments[0]}"
                           "&row=${arguments[1]}`).then(answer => answer.json())", int(x * 164), int(y * 524))
            self.assertFalse(cell["gone"])
            words = "nothing seen"
            if cell["seen"]:
                words = cell["object"].replace("_", " ")
                told[cell["object"]] = cell["nrcs_dB"]
            self.wait(lambda: self.page.find_element("id", "bknown").text.startswith(words), words)
        self.assertGreater(len(told), 0)
        self.keep("live-cell")

    def test_freeze_holds_the_picture_and_lets_it_go(self):
        self.page.find_element("id", "freeze").click()
        held = self.number()
        time.sleep(1.5)
        self.assertEqual(self.number(), held)
        self.page.find_element("id", "freeze").click()
        self.wait(lambda: self.number() > held, "newer frame")

    def test_rain_set_on_the_page_dims_the_picture_and_the_plan_says_so(self):
        dry = self.mean()
        rain = self.page.find_element("id", "rain")
        rain.send_keys(Keys.END)
        self.assertEqual(self.page.find_element("id", "raintold").text, "50 mm/h")
        self.wait(lambda: self.mean() < dry - 10, "darker picture")  # it takes more than it sends
        weather = self.js("fetch('/api/weather').then(answer => answer.json())")
        self.assertEqual(weather, {"rain_rate_mm_per_h": 50, "visibility_m": 300})
        self.page.find_element("css selector", "summary").click()
        rows = self.js("[...document.querySelectorAll('#plan tr')].map(row =>"
                       " [row.cells[0].textContent, row.cells[1].textContent])")
        self.assertEqual(dict(rows)["rain-echo"], "on")
        self.keep("live-rain")
        rain.send_keys(Keys.HOME)
        self.wait(lambda: self.mean() > dry - 5, "dry picture")

    def test_keys_change_colours_and_marks(self):
        body = self.page.find_element("css selector", "body")
        body.send_keys("c")
        self.assertEqual(self.js("state.map"), "viridis")
        body.send_keys("r")
        self.assertEqual(self.page.find_element("id", "rings").get_attribute("aria-pressed"), "false")

    def test_small_screens_and_large_letters_need_no_sideways_scrolling(self):
        for width, zoom in ((360, 1), (1200, 2)):
            self.page.set_window_size(width, 900)
            self.page.execute_script(f"document.documentElement.style.fontSize = '{100 * zoom}%'")
            time.sleep(0.3)
            inner, wide = self.js("[innerWidth, document.documentElement.scrollWidth]")
            self.assertLessEqual(wide, inner)
            self.keep(f"live-{width}-{zoom}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
