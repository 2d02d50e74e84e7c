#!/usr/bin/python3
"""The live page in a real browser: Chromium without a window, driven by Selenium (./dev live-test).

usage: browser_test.py FANBEAM [FOLDER]   FOLDER keeps screenshots
"""
import itertools
import json
import os
import re
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error
import urllib.request

import jsonschema
from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.actions import interaction
from selenium.webdriver.common.actions.action_builder import ActionBuilder
from selenium.webdriver.common.actions.pointer_input import PointerInput
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


def start_live(http, *options):
    # A rate that leaves the machine to the browser too.
    live = subprocess.Popen(
        [FANBEAM, "live", "--http", http, "--rate", "5", "--rays-per-cell", "0.5", *options],
        stdout=subprocess.PIPE, text=True)
    return live, re.search(r"http://\S+", live.stdout.readline()).group(0)


class OnePage(unittest.TestCase):
    """Of one flight, for all cases of a class."""

    @classmethod
    def setUpClass(cls):
        # Unlike the circle the approach sees ground all the time: rain has something to dim.
        cls.live, cls.url = start_live("0", "--from", "ils")
        cls.page = browser(1200, 900)

    @classmethod
    def tearDownClass(cls):
        cls.page.quit()
        cls.live.terminate()
        assert cls.live.wait(10) == 0, "a clean end"
        cls.live.stdout.close()

    def js(self, script, *arguments):
        return self.page.execute_script("return " + script, *arguments)


class Page(OnePage):
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

    def number(self):
        return int(self.js("document.body.dataset.frame || 0"))

    def keep(self, name):
        if FOLDER:
            os.makedirs(FOLDER, exist_ok=True)
            self.page.save_screenshot(os.path.join(FOLDER, name + ".png"))

    def far_mean(self):
        """Of the upper half of the B-scope."""
        return self.js("(half => half.reduce((a, b) => a + b) / half.length)"
                       "(state.frame.bscope.slice(0, state.frame.bscope.length / 2))")

    def test_frames_arrive_in_order_whole_and_changing(self):
        self.page.execute_script(
            "window.arrivals = []; const before = take; take = buffer => { before(buffer);"
            " arrivals.push([state.frame.head.number, state.frame.bscope.length, state.frame.cscope.length,"
            " state.frame.bscope.reduce((a, b) => (a * 31 + b) | 0, 7)]); };")
        self.wait(lambda: self.js("arrivals.length") >= 10, "ten frames")
        arrivals = self.js("arrivals")
        numbers = [one[0] for one in arrivals]
        self.assertEqual(numbers, sorted(set(numbers)))
        self.assertEqual({(one[1], one[2]) for one in arrivals}, {(164 * 524, 164 * 524)})
        self.assertEqual(len({one[3] for one in arrivals}), len(arrivals))
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

    def test_keys_read_the_scopes_cell_by_cell(self):
        ActionChains(self.page).send_keys("f").perform()  # freeze
        held = self.number()
        for name, told, rows in (("bscope", "btold", 524), ("cscope", "ctold", 524)):
            scope = self.page.find_element("id", name)
            self.page.execute_script("arguments[0].focus()", scope)
            scope.send_keys(Keys.ARROW_LEFT, Keys.ARROW_UP, Keys.SHIFT + Keys.ARROW_UP)
            self.wait(lambda: self.js(f"Math.floor(state.cursor.{name}[1] * {rows})") == rows // 2 - 21, "row")
            self.assertEqual(self.js(f"Math.floor(state.cursor.{name}[0] * 164)"), 81)
            grey = self.js(f"state.frame.{name}[({rows} / 2 - 21) * 164 + 81]")
            self.wait(lambda: f": grey {grey}," in self.page.find_element("id", told).text, f"grey {grey}")
            self.assertEqual(self.number(), held)  # arrows go back in time elsewhere only
            self.assertIn(f": grey {grey},", self.page.find_element("id", "spoken").get_attribute("textContent"))
            if name == "bscope":
                self.keep("live-keys")

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

    def test_stepping_back_shows_frames_that_were_shown(self):
        self.page.execute_script(
            "window.shown = {}; const before = take; take = buffer => { before(buffer);"
            " shown[state.frame.head.number] = state.frame.bscope.reduce((a, b) => (a * 31 + b) | 0, 7); };")
        self.wait(lambda: self.js("Object.keys(shown).length") >= 5, "five frames")
        body = self.page.find_element("css selector", "body")
        body.send_keys("f")
        newest = self.number()
        body.send_keys(Keys.ARROW_LEFT, Keys.ARROW_LEFT, Keys.ARROW_LEFT)
        self.assertEqual(self.number(), newest - 3)
        self.assertEqual(self.js("state.frame.bscope.reduce((a, b) => (a * 31 + b) | 0, 7)"),
                         self.js("shown[arguments[0]]", str(newest - 3)))
        told, come_ms = self.page.find_element("id", "backtold").text, self.js("state.past.map(one => one.come_ms)")
        self.assertEqual(told, self.js("(arguments[0] / 1000).toFixed(1) + ' s'", come_ms[-1] - come_ms[-4]))
        # Its truth too, however long it is held.
        time.sleep(3.0)
        cell = self.js("fetch(`/api/cell?scope=bscope&frame=${state.frame.head.number}&column=82&row=300`)"
                       ".then(answer => answer.json())")
        self.assertFalse(cell["gone"])
        body.send_keys(Keys.ARROW_RIGHT)
        self.assertEqual(self.number(), newest - 2)
        # Back at the frame that was frozen it stays so; who never froze one sees frames come again.
        body.send_keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
        time.sleep(1.0)
        self.assertEqual(self.number(), newest)
        self.assertEqual(self.page.find_element("id", "freeze").get_attribute("aria-pressed"), "true")
        body.send_keys("n")
        self.wait(lambda: self.number() > newest, "newer frame")
        body.send_keys(Keys.ARROW_LEFT)
        self.assertTrue(self.js("state.frozen"))
        body.send_keys(Keys.ARROW_RIGHT)
        self.assertFalse(self.js("state.frozen"))

    def test_a_finger_that_taps_a_picture_reads_it(self):
        self.page.find_element("id", "freeze").click()
        scope = self.page.find_element("id", "bscope")
        ActionChains(self.page).move_to_element(self.page.find_element("id", "scene")).perform()
        touch = PointerInput(interaction.POINTER_TOUCH, "finger")
        for offset in (-120, 90):
            before = self.page.find_element("id", "btold").text
            tap = ActionBuilder(self.page, mouse=touch)
            tap.pointer_action.move_to(scope, 30, offset).pointer_down().pointer_up()
            tap.perform()
            told = self.page.find_element("id", "btold").text
            self.assertRegex(told, r"^range \d+ m, azimuth .*: grey \d+, \S+ dB$")
            self.assertNotEqual(told, before)

    def bright(self, canvas):  # mean of what the canvas shows
        return self.js("(canvas => { const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d',"
                       " { willReadFrequently: true }); copy.drawImage(canvas, 0, 0); const bytes ="
                       " copy.getImageData(0, 0, canvas.width, canvas.height).data; let sum = 0; for (let i = 0; i < bytes.length; i += 4) sum += bytes[i];"
                       " return sum * 4 / bytes.length; })(document.getElementById(arguments[0]))", canvas)

    def test_gain_and_levels_change_what_is_seen(self):
        self.page.find_element("id", "freeze").click()
        time.sleep(0.3)
        plain = self.bright("bscope")
        self.page.find_element("id", "gain").send_keys(Keys.PAGE_UP, Keys.PAGE_UP)
        time.sleep(0.3)
        self.assertGreater(self.bright("bscope"), plain + 5)
        self.page.find_element("id", "freeze").click()
        mean = self.far_mean()
        low = self.page.find_element("id", "low")
        low.clear()
        low.send_keys("-35", Keys.TAB)  # black where -55 dB was: darker
        self.wait(lambda: self.far_mean() < mean - 10, "darker picture")
        self.assertEqual(self.js("fetch('/api/sensor').then(answer => answer.json())")["low_dB"], -35)
        # The tilt leaves the levels alone, and the other way round.
        sensor = lambda: self.js("fetch('/api/sensor').then(answer => answer.json())")
        tilt_deg = sensor()["tilt_deg"]
        self.page.find_element("id", "tilt").send_keys(Keys.ARROW_RIGHT)
        self.wait(lambda: sensor()["tilt_deg"] > tilt_deg, "another tilt")
        self.assertEqual(sensor()["low_dB"], -35)
        tilt_deg = sensor()["tilt_deg"]
        low.clear()
        low.send_keys("-55", Keys.TAB)
        self.wait(lambda: sensor()["low_dB"] == -55, "levels as they were")
        self.assertEqual(sensor()["tilt_deg"], tilt_deg)
        self.page.find_element("id", "tilt").send_keys(Keys.ARROW_LEFT)
        self.wait(lambda: self.far_mean() > mean - 10, "picture as it was")

    def test_a_held_frame_is_read_by_its_own_levels(self):
        self.page.find_element("id", "freeze").click()
        def told():
            self.page.execute_script("state.cursor.bscope = [0.6, 0.4]; tell('bscope')")
            return self.page.find_element("id", "btold").text
        held, low = told(), self.page.find_element("id", "low")
        self.assertIn(" dB", held)
        try:
            low.clear()
            low.send_keys("-35", Keys.TAB)
            self.wait(lambda: self.js("state.sensor.low_dB") == -35, "other levels")
            self.assertEqual(told(), held)
            self.assertEqual(self.js("state.frame.head.low_dB"), -55)
        finally:
            low.clear()
            low.send_keys("-55", Keys.TAB)
            self.wait(lambda: self.js("state.sensor.low_dB") == -55, "levels as they were")

    def test_the_tilt_leaves_levels_alone_that_another_set(self):
        def post(body):
            urllib.request.urlopen(urllib.request.Request(
                self.url + "api/sensor", data=json.dumps(body).encode(),
                headers={"Content-Type": "application/json"}), timeout=10).close()
        sensor = lambda: self.js("fetch('/api/sensor').then(answer => answer.json())")
        before = sensor()
        try:
            post({"tilt_deg": before["tilt_deg"], "low_dB": -47, "high_dB": 9})
            self.page.get(self.url)
            self.wait(lambda: self.js("state.sensor && state.sensor.low_dB") == -47, "its levels")
            self.page.find_element("id", "tilt").send_keys(Keys.ARROW_RIGHT)
            self.wait(lambda: sensor()["tilt_deg"] > before["tilt_deg"], "another tilt")
            self.assertEqual((sensor()["low_dB"], sensor()["high_dB"]), (-47, 9))
        finally:
            post({})

    def test_the_plan_view_shows_the_picture_and_outlines_the_runway(self):
        self.assertEqual(self.js("state.runways.map(runway => runway.corners.length)"), [4])
        self.wait(lambda: self.bright("planview") > 3, "plan view")
        self.page.find_element("id", "freeze").click()
        time.sleep(0.3)
        outlined = self.bright("planview")
        # Told on the other side of the date line: nothing but its digits changes.
        self.js("state.runways.forEach(runway => runway.corners.forEach(corner => { corner[1] -= 360; })), show()")
        time.sleep(0.3)
        self.assertAlmostEqual(self.bright("planview"), outlined, delta=1e-3)
        self.assertAlmostEqual(self.js("east_deg(-179.99, 179.98)"), 0.03, 6)
        self.assertAlmostEqual(self.js("east_deg(179.98, -179.99)"), -0.03, 6)
        self.page.find_element("id", "rings").click()
        time.sleep(0.3)
        self.assertNotEqual(self.bright("planview"), outlined)
        self.keep("live-plan")

    def test_the_plan_view_of_a_sensor_that_looks_aside_is_turned_with_it(self):
        self.page.find_element("id", "freeze").click()
        self.page.execute_script(
            "window.corners = []; const line = CanvasRenderingContext2D.prototype.lineTo;"
            " CanvasRenderingContext2D.prototype.lineTo = function (x, y) {"
            " if (this.canvas.id === 'planview') corners.push(Math.round(x), Math.round(y)); line.call(this, x, y); };")

        def drawn(heading_deg, yaw_deg):
            return self.page.execute_script(
                "corners = []; state.frame.head.heading_deg = arguments[0];"
                " state.sensor = { ...state.sensor, mounting_yaw_deg: arguments[1] }; tell_mounting(); draw_plan();"
                " return [corners, byId('planhead').textContent, axes('bscope').words(0.5, 0.5)];", heading_deg, yaw_deg)
        ahead, head, words = drawn(264, 0)
        self.assertEqual(head, "Plan view: nose up")
        self.assertRegex(words, r"azimuth 0\.0°$")
        aside, head, words = drawn(264, 10)
        self.assertEqual(head, "Plan view: antenna up, nose 10.0° to its left")
        self.assertRegex(words, r"azimuth 0\.0° of the antenna$")
        self.assertNotEqual(aside, ahead)
        self.assertEqual(drawn(274, 0)[0], aside)
        self.assertEqual(drawn(264, -90)[1], "Plan view: antenna up, nose 90.0° to its right")

    def test_a_film_is_recorded(self):
        self.page.find_element("id", "record").click()
        time.sleep(2)
        self.page.find_element("id", "record").click()
        self.wait(lambda: self.js("tape.film ? tape.film.size : 0") > 10000, "film")
        head = self.js("tape.film.slice(0, 4).arrayBuffer().then(bytes => [...new Uint8Array(bytes)])")
        self.assertEqual(head, [0x1a, 0x45, 0xdf, 0xa3], "EBML, as WebM begins")
        # The next one takes its place in memory.
        first = self.js("tape.url")
        self.page.execute_script("window.left = []; const leave = URL.revokeObjectURL.bind(URL);"
                                 " URL.revokeObjectURL = url => { left.push(url); leave(url); }; record(); record();")
        self.wait(lambda: self.js("tape.recorder === null"), "another film")
        self.assertEqual(self.js("left"), [first])
        self.assertNotEqual(self.js("tape.url"), first)

    def test_frames_come_where_no_websocket_gets_through(self):
        script = self.page.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source":
            "window.WebSocket = class { constructor() { setTimeout(() => this.onclose(), 10); } };"})
        try:
            self.page.get(self.url)
            self.wait(lambda: self.number() > 0, "a frame")
            first = self.number()
            self.wait(lambda: self.number() > first + 3, "more frames")
        finally:
            self.page.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", script)

    def test_a_player_of_cameras_shows_the_stream(self):
        for path, name in (("stream", "bscope"), ("stream/cscope", "cscope")):
            shown = subprocess.run(
                ["ffmpeg", "-v", "error", "-f", "mpjpeg", "-i", self.url + path, "-frames:v", "3", "-f", "rawvideo",
                 "-pix_fmt", "gray", "-"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=60, check=False)
            self.assertEqual(shown.stderr, b"")
            columns, rows = self.js(f"state.frame.head.{name}")
            self.assertEqual(len(shown.stdout), 3 * columns * rows)
            self.assertGreater(len(set(shown.stdout)), 100)

    def test_answers_are_what_the_description_says(self):
        def asked(path, body=None):
            request = urllib.request.Request(self.url + path, data=body and json.dumps(body).encode(),
                                             headers={"Content-Type": "application/json"})
            try:
                return json.load(urllib.request.urlopen(request, timeout=10))
            except urllib.error.HTTPError as refused:
                self.assertEqual(refused.code, 422)
                return json.load(refused)
        api = asked("api/openapi.json")

        def hold(answer, schema):
            jsonschema.Draft202012Validator({**schema, "components": api["components"]}).validate(answer)

        def check(answer, name):
            hold(answer, {"$ref": f"#/components/schemas/{name}"})
        for path, one in api["paths"].items():
            content = one["get"]["responses"].get("200", {}).get("content", {}).get("application/json", {})
            if content and path != "/api/cell":
                hold(asked(path[1:]), content["schema"])
        for number in (self.number(), 10**9):
            check(asked(f"api/cell?scope=bscope&frame={number}&column=80&row=300"), "Cell")
        check(asked("api/cell?scope=x"), "Problems")
        check(asked("api/weather", {"visibility_m": 1, "snow": 2}), "Problems")
        check(asked("api/sensor", {"tilt_deg": "up"}), "Problems")
        check(self.js("state.frame.head"), "FrameHead")

    def test_rain_set_on_the_page_dims_what_lies_far_and_the_plan_says_so(self):
        # Near the antenna it sends more than it takes: where the flight is by now must not matter.
        # Not before the approach sees ground that far: rain has nothing to dim in what is black.
        self.wait(lambda: self.far_mean() > 80, "ground far away")
        dry = self.far_mean()
        rain = self.page.find_element("id", "rain")
        rain.send_keys(Keys.END)
        self.assertEqual(self.page.find_element("id", "raintold").text, "50 mm/h")
        self.wait(lambda: self.far_mean() < dry - 20, "darker picture")
        weather = self.js("fetch('/api/weather').then(answer => answer.json())")
        self.assertEqual(weather, {"rain_rate_mm_per_h": 50, "snow_rate_mm_per_h": 0, "visibility_m": 300,
                                   "melting_layer": False})
        self.page.find_element("css selector", "summary").click()
        rows = self.js("[...document.querySelectorAll('#plan tr')].map(row =>"
                       " [row.cells[0].textContent, row.cells[1].textContent])")
        self.assertEqual(dict(rows)["rain-echo"], "on")
        self.keep("live-rain")
        rain.send_keys(Keys.HOME)
        self.wait(lambda: self.far_mean() > dry - 10, "dry picture")

    def test_a_slider_takes_the_other_away_where_both_cannot_be(self):
        self.page.execute_script("window.posted = []; post = async (path, body) => { posted.push(body); }")
        for melts in (False, True):
            self.page.execute_script("weather = { rain_rate_mm_per_h: 4, snow_rate_mm_per_h: 2, visibility_m: null,"
                                     " melting_layer: arguments[0] }; posted = [];"
                                     " byId('rain').value = 5; byId('rain').dispatchEvent(new Event('change'));"
                                     " byId('rain').value = 4; byId('snow').value = 3; byId('snow').dispatchEvent(new Event('change'));", melts)
            rates = self.js("posted.map(body => [body.rain_rate_mm_per_h, body.snow_rate_mm_per_h])")
            self.assertEqual(rates, [[5, 2], [5, 3]] if melts else [[5, 0], [0, 3]])

    def test_keys_change_colours_and_marks(self):
        body = self.page.find_element("css selector", "body")
        body.send_keys("c")
        self.assertEqual(self.js("state.map"), "viridis")
        body.send_keys("r")
        self.assertEqual(self.page.find_element("id", "rings").get_attribute("aria-pressed"), "false")

    def test_letters_are_keys_with_a_slider_in_focus_too(self):
        self.wait(lambda: self.js("state.past.length") >= 3, "three frames")
        back = self.page.find_element("id", "back")
        back.send_keys(Keys.ARROW_LEFT, Keys.ARROW_LEFT)
        self.wait(lambda: self.js("state.frozen"), "a held frame")
        held = self.js("state.back")
        back.send_keys("c")
        self.assertEqual(self.js("[state.map, state.back]"), ["viridis", held])
        back.send_keys("n")
        self.assertEqual(self.js("[state.frozen, state.back]"), [False, 0])
        # Its arrows are its own, and a number's letters, if there were any.
        gain = self.page.find_element("id", "gain")
        gain.send_keys(Keys.ARROW_LEFT)
        self.assertEqual(self.js("[state.gain_dB, state.frozen]"), [-1, False])
        self.page.find_element("id", "low").send_keys("f")
        self.assertFalse(self.js("state.frozen"))

    def test_short_and_long_ranges_and_wide_scans_have_marks_that_do_not_cover_each_other(self):
        self.page.find_element("id", "freeze").click()
        self.page.execute_script(
            "window.written = {}; const fill = CanvasRenderingContext2D.prototype.fillText;"
            " CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {"
            " (written[this.canvas.id] ||= []).push([text, x, y, this.measureText(text).width]);"
            " fill.call(this, text, x, y); };")
        for nearest_m, farthest_m, view_deg, step_m in ((1, 151, 150, 20), (200, 3695.08, 41, 500), (0, 20000, 41, 2000)):
            written = self.page.execute_script(
                "written = {}; state.frame.head.cscope_top_deg = 10;"
                " state.sensor = { ...state.sensor, range_minimum_m: arguments[0], field_of_view_deg: arguments[2], cscope_span_deg: 20,"
                " range_cell_m: (arguments[1] - arguments[0]) / state.sensor.range_cells };"
                " draw('bscope'); draw('cscope'); draw_plan(); return written;", nearest_m, farthest_m, view_deg)
            ranges = [r * step_m for r in range(-(-nearest_m // step_m), int(farthest_m / step_m + 1)) if r * step_m < farthest_m]
            # At the lower edge, where azimuths are told, a line has no word.
            self.assertEqual([text for text, *_ in written["bscope"] if text.endswith(" m")], [f"{r} m" for r in ranges if r > nearest_m])
            self.assertEqual([text for text, *_ in written["cscope"] if text.endswith(".0°")], ["\u22125.0°", "0.0°", "5.0°"])
            rings = [text for text, *_ in written["planview"] if re.fullmatch(r"[\d.]+ k?m", text)]
            self.assertEqual(rings, [f"{r} m" if r < 1000 else f"{r / 1000:g} km" for r in ranges])
            for scope in ("bscope", "cscope"):
                self.assertGreaterEqual(len([text for text, *_ in written[scope] if re.fullmatch(r"\u2212?\d+°", text)]), 3)
                for (one, x, y, wide), (other, left, below, width) in itertools.combinations(written[scope], 2):
                    self.assertTrue(x + wide < left or left + width < x or abs(y - below) > 12, f"{one} covers {other}")
            self.keep(f"live-marks-{farthest_m:g}")

    def test_small_screens_and_large_letters_need_no_sideways_scrolling(self):
        for width, zoom in ((360, 1), (1200, 2)):
            self.page.set_window_size(width, 900)
            self.page.execute_script(f"document.documentElement.style.fontSize = '{100 * zoom}%'")
            time.sleep(0.3)
            inner, wide = self.js("[innerWidth, document.documentElement.scrollWidth]")
            self.assertLessEqual(wide, inner)
            self.keep(f"live-{width}-{zoom}")


class Rate(unittest.TestCase):
    """A benchmark: told, not judged. Renderer, server and browser share this machine."""

    SECONDS = 10

    def test_frames_a_second_that_the_page_shows_at_sixteen(self):
        live = subprocess.Popen([FANBEAM, "live", "--http", "0", "--rate", "16"], stdout=subprocess.PIPE, text=True)
        self.addCleanup(live.stdout.close)
        self.addCleanup(live.wait, 10)
        self.addCleanup(live.terminate)
        url = re.search(r"http://\S+", live.stdout.readline()).group(0)
        page = browser(1200, 900)
        self.addCleanup(page.quit)
        page.get(url)
        page.execute_script("window.got = 0; const before = take; take = buffer => { before(buffer); ++got; };"
                            " window.shown = new Set(); const look = () => { shown.add(document.body.dataset.frame);"
                            " requestAnimationFrame(look); }; look();")
        time.sleep(5)  # the pace finds what there is room for
        page.execute_script("got = 0; shown.clear();")
        time.sleep(self.SECONDS)
        got, shown = page.execute_script("return [got, shown.size]")
        status = page.execute_script("return fetch('/api/status').then(answer => answer.json())")
        told = {"wanted_Hz": 16, "rendered_Hz": status["rate_Hz"], "arrived_Hz": got / self.SECONDS,
                "drawn_Hz": shown / self.SECONDS, "samples": status["samples"], "cores": os.cpu_count(),
                "load_average": os.getloadavg()[0]}
        print("\n" + ", ".join(f"{key} {value:.3g}" for key, value in told.items()), file=sys.stderr)
        if FOLDER:
            os.makedirs(FOLDER, exist_ok=True)
            with open(os.path.join(FOLDER, "rate.json"), "w", encoding="ascii") as file:
                json.dump(told, file, indent=1)
        self.assertGreater(got, self.SECONDS)  # one a second, or something stands
        self.assertGreater(shown, self.SECONDS)


class AnotherServer(unittest.TestCase):
    def test_the_page_that_stays_open_shows_the_scene_of_the_server_that_is_there_now(self):
        live, url = start_live("0", "--from", "circle", "flat-grass")
        page = browser(800, 600)
        try:
            def wait(script, what):
                for _ in range(300):
                    if page.execute_script("return " + script):
                        return
                    time.sleep(0.1)
                self.fail(f"no {what} within 30 s")
            page.get(url)
            wait("state.scene === 'flat-grass' && state.past.length > 5", "frames of the first scene")
            self.assertEqual(page.execute_script("return state.runways"), [])
            first = page.execute_script("return state.past[0].come_ms")
            # As after a connection that was cut: the same server's frames stay, and what is frozen.
            page.execute_script("press.freeze()")
            held = page.execute_script("return state.past.length")
            page.execute_async_script("const done = arguments[0]; greet().then(() => done(), () => done())")
            self.assertEqual(page.execute_script("return [state.frozen, state.past.length]"), [True, held])
            page.execute_script("press.freeze()")
            live.terminate()
            self.assertEqual(live.wait(10), 0)
            live.stdout.close()
            live, _ = start_live(re.search(r":(\d+)/", url).group(1), "--from", "ils", "braunschweig-26")
            wait("state.scene === 'braunschweig-26' && state.past.length > 1", "frames of the second scene")
            self.assertEqual(page.execute_script("return state.runways.length"), 1)
            self.assertGreater(page.execute_script("return state.past[0].come_ms"), first)
            numbers = page.execute_script("return state.past.map(one => one.head.number)")
            self.assertEqual(numbers, sorted(set(numbers)))
        finally:
            page.quit()
            live.terminate()
            live.wait(10)


class BeyondThisMachine(unittest.TestCase):
    TOKEN = "aB3-._~7aB3-._~7"

    def test_the_page_opens_with_the_token_alone(self):
        with tempfile.NamedTemporaryFile("w") as file:
            file.write(self.TOKEN + "\n")
            file.flush()
            live, url = start_live("0.0.0.0:0", "--token-file", file.name)
            page = browser(800, 600)
            try:
                own = subprocess.run(["hostname", "-I"], stdout=subprocess.PIPE, text=True, check=False).stdout.split()
                url = url.replace("0.0.0.0", own[0] if own and "." in own[0] else "127.0.0.1")
                for path in ("", "frame/bscope.png", "stream", "?token=" + self.TOKEN[1:]):
                    with self.assertRaises(urllib.error.HTTPError) as refused:
                        urllib.request.urlopen(url + path, timeout=10)
                    self.assertEqual(refused.exception.code, 401)
                for _ in range(2):  # with the cookie there too
                    page.get(url + "?token=" + self.TOKEN)
                    self.assertEqual(page.current_url, url)  # the token does not stay in the history
                for _ in range(150):
                    if page.execute_script("return document.body.dataset.frame"):
                        break
                    time.sleep(0.1)
                self.assertTrue(page.execute_script("return document.body.dataset.frame"))
                self.assertEqual(page.execute_script("return document.cookie"), "")
                self.assertEqual(page.get_log("browser"), [])
            finally:
                page.quit()
                live.terminate()
                live.wait(10)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
