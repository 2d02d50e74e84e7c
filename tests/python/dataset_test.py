"""The worked example of docs/dataset.md, smaller: what it draws, and that its baseline finds runways in clear air."""

import re
import subprocess
import sys


def test_the_worked_example_runs_and_finds_runways(program, root, tmp_path):
    example = root / "bindings" / "python" / "examples" / "dataset"
    text = (example / "approaches.toml").read_text(encoding="utf-8")
    text = re.sub(r"(?m)^scenes = .*$", 'scenes = ["braunschweig-26"]', text)
    text = re.sub(r"(?m)^scene = .*\n", "", text)
    text = text.replace("runs = 200", "runs = 16").replace("[0, 0.5, 1, 2, 4, 8]", "[0, 8]")
    (tmp_path / "approaches.toml").write_text(text, encoding="utf-8")
    for task in ("run", "merge"):
        subprocess.run([program, "campaign", task, tmp_path / "approaches.toml", "-o", tmp_path / "out", "-q"], check=True)
    shown = subprocess.run(
        [sys.executable, example / "show_dataset.py", "out", "shown-"], cwd=tmp_path, check=True, capture_output=True, text=True
    )
    assert shown.stdout.strip() == "16 approaches, 80 frames"
    assert (tmp_path / "shown-mosaic.png").stat().st_size > 100_000
    assert (tmp_path / "shown-parameters.png").stat().st_size > 10_000
    found = subprocess.run(
        [sys.executable, example / "find_runway.py", "out"], cwd=tmp_path, check=True, capture_output=True, text=True
    )
    frames, share = map(int, re.search(r"(\d+) frames, found in (\d+) %", found.stdout).groups())
    # Half of the runs are in heavy rain, where it finds next to none; in the others nearly all.
    assert 30 <= frames <= 40 and 35 <= share <= 75
    assert (tmp_path / "runway.png").stat().st_size > 10_000
