"""read_dcc.py FILE EXPECTED [SCHEMA]: compares a digital certificate with the session's numbers, by pydcc and, where it
runs, dccQuantities; validates it against PTB's dcc.xsd 3.3.0 and what that imports, where the folder SCHEMA is."""
import json
import math
import os
import sys
import tempfile
import types
from pathlib import Path

file, expected = Path(sys.argv[1]), json.loads(Path(sys.argv[2]).read_text())
schema = Path(sys.argv[3]) if len(sys.argv) > 3 and sys.argv[3] else None

# What pydcc asks of the network, and a library that does not know today's OpenSSL: neither is needed to read numbers.
validator = types.ModuleType("dcc.dcc_xml_validator")
validator.DCCXMLValidator = lambda: None
sys.modules["dcc.dcc_xml_validator"] = validator
chain = types.ModuleType("certvalidator")
chain.CertificateValidator = chain.ValidationContext = chain.errors = object
sys.modules["certvalidator"] = chain
from dcc.dcc import DCC  # noqa: E402


def numbers(text):
    return [float(each) for each in text.split()]


def same(a, b):
    return a == b or (math.isnan(a) and math.isnan(b))


def number(row, key):
    return math.nan if row[key] is None else row[key]


def check(values, of, what):
    assert len(values) == len(of) and all(map(same, values, of)), f"{what}: {values} is not {of}"


read = DCC(str(file))
assert read.version() == "3.3.0", read.version()
assert not read.is_signed() if hasattr(read, "is_signed") else True
results = [(path, si) for path, si in read.get_calibration_results("xpath") if si]
tables = [si for path, si in results if "basic_measurementError" in path]
set_values = [si for path, si in results if "basic_nominalValue" in path]
assert len(tables) == len(expected["tables"]), (len(tables), len(expected["tables"]))


def find(node, name):
    """The first text below that is called so, whatever the namespace."""
    if isinstance(node, dict):
        for key, value in node.items():
            if key.rsplit("}", 1)[-1].rsplit(":", 1)[-1] == name:
                return value
            found = find(value, name)
            if found is not None:
                return found
    return None


for si, at, rows in zip(tables, set_values, expected["tables"]):
    error = [number(row, "error") for row in rows]
    check(numbers(find(si, "valueXMLList")), error, "error")
    check(numbers(find(at, "valueXMLList")), [float(f"{row['commanded']:.12g}") for row in rows], "set")
    u = [number(row, "expanded_uncertainty") if row["error"] is not None else math.nan for row in rows]
    if all(map(math.isnan, u)):
        assert find(si, "valueExpandedMUXMLList") is None
        continue
    check(numbers(find(si, "valueExpandedMUXMLList")), u, "U")
    k = [math.nan if math.isnan(each) else number(row, "coverage_factor") for each, row in zip(u, rows)]
    check(numbers(find(si, "coverageFactorXMLList")), k, "k")
    check(numbers(find(si, "coverageProbabilityXMLList")), [0.95] * len(k), "p")

if schema is None:
    sys.exit(0)
from lxml import etree  # noqa: E402


class Here(etree.Resolver):
    def resolve(self, url, public, context):
        name = Path(url).name
        return self.resolve_filename(str(schema / name), context)


parser = etree.XMLParser(no_network=True)
parser.resolvers.add(Here())
xsd = etree.XMLSchema(etree.parse(str(schema / "dcc.xsd"), parser))
tree = etree.parse(str(file))
assert xsd.validate(tree), xsd.error_log

os.environ["XDG_CACHE_HOME"] = tempfile.mkdtemp()
os.environ.setdefault("LANG", "en_US.UTF-8")
import requests  # noqa: E402

requests.get = lambda url, *_, **__: types.SimpleNamespace(
    text=(schema / Path(url).name).read_text(encoding="utf-8"), status_code=200, url=url)
from dcc_json_toolkit import DccSchema  # noqa: E402

found = DccSchema("3.3.0").validate_dcc(str(file))
assert not found, found


# dccQuantities calculates with METAS UncLib, which wants .NET; its numbers can be read without.
class Uncertain:
    def __init__(self, value, u=0.0, *_, **__):
        self.value, self.u = value, u


unclib = types.ModuleType("metas_unclib")
unclib.ufloat = unclib.ufloatfromdistribution = Uncertain
unclib.ucomplex = type("Complex", (), {})
unclib.get_value, unclib.get_stdunc = (lambda each: each.value), (lambda each: each.u)
unclib.umath = unclib.UniformDistribution = types.SimpleNamespace()
sys.modules["metas_unclib"] = unclib
import warnings  # noqa: E402

warnings.simplefilter("ignore")  # that k is not that of a normal distribution
from dcc_quantities import DccQuantityType  # noqa: E402

quantities = DccQuantityType.extract_all_quantities(DccSchema("3.3.0").to_dict(str(file)))
errors = [each for each in quantities if "basic_measurementError" in (each.ref_type or [])]
assert len(errors) == len(expected["tables"]), (len(errors), [each.ref_type for each in quantities])
for quantity, rows in zip(errors, expected["tables"]):
    values = [getattr(each, "value", each) for each in quantity.data.data]
    check(values, [number(row, "error") for row in rows], "error in dccQuantities")
    for each, row in zip(quantity.data.data, rows):
        if row["error"] is None or row["expanded_uncertainty"] is None:
            continue
        u = row["expanded_uncertainty"] / row["coverage_factor"]
        assert abs(each.u - u) <= 1e-9 * u, (each.u, u)
