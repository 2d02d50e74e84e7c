#!/usr/bin/python3
"""The live page where something fails: silent sources, connections that stand, refused controls (./dev live-test).

usage: page_test.py FANBEAM
"""
import sys
import time
import unittest

from selenium.webdriver.common.keys import Keys

from browser_test import OnePage


class Faults(OnePage):
    def setUp(self):
        self.page.get(self.url)
        self.wait("state.past.length > 2", "frames")
        # As the page itself would lose them: into the console alone.
        self.run_js("window.lost = []; addEventListener('unhandledrejection', event => lost.push(String(event.reason)))")

    def tearDown(self):
        self.assertEqual(self.js("lost"), [])

    def run_js(self, script, *arguments):
        return self.page.execute_script(script, *arguments)

    def text(self, name):
        return self.js("byId(arguments[0]).textContent", name)

    def wait(self, script, what):
        for _ in range(200):
            if self.js(script):
                return
            time.sleep(0.1)
        self.fail(f"no {what} within 20 s")

    def test_a_picture_that_is_let_go_is_the_newest_though_no_other_comes(self):
        self.run_js("press.freeze()")
        held = self.js("state.frame.head.number")
        self.assertEqual(self.text("backtold"), "frozen")
        self.wait(f"state.newest.head.number > {held} + 3", "newer frames")
        self.assertEqual(self.js("state.frame.head.number"), held)
        newest = self.run_js("take = () => {}; press.freeze(); return state.newest.head.number")
        self.assertEqual(self.js("state.frame.head.number"), newest)
        self.assertEqual(self.text("backtold"), "now")

    def test_a_connection_that_stands_is_told_once_and_made_anew(self):
        self.run_js("window.opened = 0; const Plain = WebSocket;"
                    " window.WebSocket = class extends Plain { constructor(url) { super(url); ++opened; } };"
                    " window.told = []; new MutationObserver(() => told.push(byId('alarm').textContent))"
                    " .observe(byId('alarm'), { childList: true }); window.before = take; take = () => {}")
        self.wait("opened > 1", "other connections")
        self.assertIn("no frames arrive", self.text("facts"))
        self.run_js("take = before")
        self.wait("told.length > 1", "end of the alarm")
        self.assertEqual(self.js("told"), ["no frames arrive", "all is well again"])
        self.assertNotIn("no frames arrive", self.text("facts"))

    def test_a_refused_control_shows_what_is_in_force(self):
        in_force = self.js("state.sensor.tilt_deg")
        self.run_js("byId('tilt').value = 4; tell_control('tilt', 4); control('/api/sensor', () => ({ tilt_deg: 91 }))")
        self.wait("byId('refused').textContent", "refusal")
        self.assertTrue(self.text("refused").startswith("not set: "), self.text("refused"))
        self.wait(f"+byId('tilt').value === {in_force}", "tilt that is in force")
        self.assertEqual(self.js("byId('tilt').getAttribute('aria-valuetext')"), self.js("deg(state.sensor.tilt_deg)"))
        # One that lies beyond the slider is told all the same.
        self.run_js("control('/api/sensor', () => ({ tilt_deg: -20.5 }))")
        self.wait("byId('tilttold').textContent === '\u221220.5\u00b0'", "tilt beyond the slider")
        self.assertEqual(self.text("refused"), "")
        self.run_js("control('/api/sensor', () => ({}))")
        self.wait(f"state.sensor.tilt_deg === {in_force}", "tilt as it was")

    def test_a_control_that_never_arrives_shows_what_is_in_force(self):
        self.run_js("window.plain = fetch; window.fetch = () => Promise.reject(new TypeError('cut'));"
                    " byId('rain').value = 20; byId('rain').dispatchEvent(new Event('input'));"
                    " byId('rain').dispatchEvent(new Event('change'))")
        self.wait("byId('refused').textContent === 'not set: no answer from fanbeam'", "refusal")
        self.wait("byId('facts').textContent === 'no answer from fanbeam'", "word of it")
        self.assertEqual(self.text("alarm"), "no answer from fanbeam")
        self.run_js("window.fetch = plain")
        self.wait("byId('rain').value === '0' && byId('raintold').textContent === 'none'", "rain that is in force")

    def test_fog_and_rain_leave_each_other_alone(self):
        # Answers of a second ago, as over a slow line.
        self.run_js("window.plain = fetch; window.fetch = async (path, options) => {"
                    " const answer = await plain(path, options);"
                    " if (path === '/api/weather' && !options.method) await new Promise(done => setTimeout(done, 1000));"
                    " return answer; }")
        try:
            time.sleep(0.5)
            for name, value in (("fog", 20), ("rain", 5), ("fog", 10), ("rain", 8)):
                self.run_js("byId(arguments[0]).value = arguments[1]; byId(arguments[0]).dispatchEvent(new Event('change'))",
                            name, value)
                time.sleep(0.7)
            self.assertEqual(self.js("plain('/api/weather').then(answer => answer.json()).then(w =>"
                                     " [w.visibility_m, w.rain_rate_mm_per_h])"), [self.js("visibility(10)"), 8])
        finally:
            self.run_js("window.fetch = plain; set_weather({ visibility_m: null, rain_rate_mm_per_h: 0 })")
            self.wait("plain('/api/weather').then(answer => answer.json()).then(w => w.visibility_m === null)", "clear air")

    def test_a_key_is_answered_once_though_frames_come(self):
        self.run_js("window.said = 0; new MutationObserver(all => { said += all.length; })"
                    " .observe(byId('spoken'), { childList: true }); byId('bscope').focus()")
        self.page.find_element("id", "bscope").send_keys(Keys.ARROW_UP)
        self.wait("byId('spoken').textContent.includes('; ')", "what stands there")
        time.sleep(4)
        self.assertEqual(self.js("said"), 2)

    def test_nothing_of_the_scene_before_stays(self):
        self.run_js("take = () => {}; state.cursor.bscope = [0.5, 0.5]; tell('bscope'); wipe()")
        self.assertEqual(self.js("[byId('aircraft').textContent, byId('bknown').textContent, state.past.length, state.frame]"),
                         ["", "", 0, None])
        time.sleep(0.3)
        for name in ("bscope", "cscope", "planview"):
            self.assertFalse(self.js("new Uint32Array(byId(arguments[0]).getContext('2d').getImageData(0, 0, byId(arguments[0]).width,"
                                     " byId(arguments[0]).height).data.buffer).some(pixel => pixel)", name), name)

    def test_what_is_kept_has_a_bound(self):
        self.run_js("state.past_bytes = 200e6")
        last = self.js("state.frame.head.number")
        self.wait(f"state.frame.head.number > {last}", "another frame")
        self.assertLessEqual(self.js("state.past_bytes"), 200e6)
        self.run_js("window.MediaRecorder = class { constructor() { throw new Error('no codec'); } }; record()")
        self.assertEqual(self.text("filmed"), "No film: this browser records no WebM (no codec).")
        self.run_js("window.MediaRecorder = class { start() { this.state = 'recording'; } stop() { this.state = 'inactive'; this.onstop(); } };"
                    " record(); for (let i = 0; i < 3; ++i) tape.recorder?.ondataavailable({ data: { size: 200e6 } })")
        self.assertEqual(self.text("filmed"), "The film ended: it has 500 MB, the most that is kept.")
        self.assertEqual(self.js("byId('record').getAttribute('aria-pressed')"), "false")

    def test_a_key_that_is_held_counts_once(self):
        self.run_js("for (const repeat of [false, true, true, true])"
                    " document.body.dispatchEvent(new KeyboardEvent('keydown', { key: 'f', repeat, bubbles: true }))")
        self.assertTrue(self.js("state.frozen"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
