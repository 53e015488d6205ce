"""What the scripts share that make figures for tests: keep(__file__, figures) is how each of them ends.

The figures stand in the JSON file of the script's name, beside it, where the tests read them. Run by itself a script
computes them once more and says whether the file still holds them; with --write it writes the file.

Exit 0: they agree. 1: they do not. 2: usage. 77: not checked, because recordings of others are not here.
"""
import json
import math
import pathlib
import sys

SHARED_DATA = pathlib.Path(__file__).resolve().parents[3] / "shared" / "data"
# Between the same figures by another numpy, scipy or processor.
TOLERANCE = 1e-9


class NoData(Exception):
    """Recordings that are not part of the tree (../shared/data) are not here."""


def shared(relative):
    path = SHARED_DATA / relative
    if not path.exists():
        raise NoData("%s is not here" % path)
    return path


def differences(kept, made, where=""):
    if isinstance(kept, dict) and isinstance(made, dict):
        for key in sorted(set(kept) | set(made)):
            at = where + "/" + key
            if key not in made:
                yield at + " is in the file only"
            elif key not in kept:
                yield at + " is not in the file"
            else:
                yield from differences(kept[key], made[key], at)
    elif isinstance(kept, list) and isinstance(made, list) and len(kept) == len(made):
        for index, (one, other) in enumerate(zip(kept, made)):
            yield from differences(one, other, "%s[%d]" % (where, index))
    elif isinstance(kept, float) or isinstance(made, float):
        numbers = all(type(one) in (int, float) for one in (kept, made))
        if not numbers or not math.isclose(kept, made, rel_tol=TOLERANCE, abs_tol=1e-15):
            yield "%s: %r in the file, %r made now" % (where, kept, made)
    elif kept != made:
        yield "%s: %r in the file, %r made now" % (where, kept, made)


def made_by(script):
    used = [name for name in ("numpy", "scipy") if name in sys.modules]
    return ", ".join(["tests/reference/" + script.name] + [name + " " + sys.modules[name].__version__ for name in used])


def keep(script, figures):
    """`figures` takes nothing and returns a dictionary of figures, which are numbers, strings, lists and dictionaries."""
    script = pathlib.Path(script).resolve()
    if sys.argv[1:] not in ([], ["--write"]):
        print("usage: %s [--write]" % script.name)
        sys.exit(2)
    try:
        made = json.loads(json.dumps(figures(), allow_nan=False))
    except NoData as missing:
        print("%s: not checked, %s" % (script.stem, missing))
        sys.exit(77)
    path = script.with_suffix(".json")
    if sys.argv[1:]:
        path.write_text(json.dumps({"made_by": made_by(script), **made}, indent=1) + "\n")
        print("%s: written" % script.stem)
        return
    kept = json.loads(path.read_text())
    kept.pop("made_by")
    found = list(differences(kept, made))
    for difference in found:
        print("%s%s" % (script.stem, difference))
    print("%s: %s" % (script.stem, "DISAGREES" if found else "agrees"))
    sys.exit(1 if found else 0)
