"""Programs that end while threads of theirs still make frames."""

import subprocess
import sys
import textwrap


def test_a_program_ends_well_while_daemon_threads_make_frames():
    # Python ended each thread that asked for its lock by then, which ended the program: SIGABRT. What is
    # destroyed slowly at the end keeps the program there until all of them have asked.
    script = textwrap.dedent("""
        import fanbeam, threading, time

        class Slow:
            def __del__(self, sleep=time.sleep):
                sleep(0.3)

        def fly():
            while True:
                scene.render(0)

        scene = fanbeam.Scene.open("flat-grass")
        slow = Slow()
        for _ in range(2):
            threading.Thread(target=fly, daemon=True).start()
        time.sleep(0.1)
        print("end")
    """)
    for _ in range(3):
        ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
        assert (ended.returncode, ended.stdout, ended.stderr) == (0, "end\n", "")
