"""check.py - every script that makes figures for tests, run once more against the file that the tests read."""
import pathlib
import subprocess
import sys

here = pathlib.Path(__file__).resolve().parent
codes = {}
for file in sorted(here.glob("*.json")):
    codes[file.stem] = subprocess.run([sys.executable, file.with_suffix(".py")]).returncode
if not codes:
    sys.exit("no figures in %s" % here)
disagree = [name for name, code in codes.items() if code not in (0, 77)]
print("%d files: %s" % (len(codes), "DISAGREE: " + ", ".join(disagree) if disagree else "none disagrees"))
sys.exit(1 if disagree else 0)
