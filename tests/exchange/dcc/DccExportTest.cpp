// Calibrations drawn at random, exported as digital certificates: they come back equal, in our reader and in others'.
#include <cmath>
#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <sys/resource.h>

#include "core/base/LocaleFreeText.h"
#include "core/base/Printable.h"
#include "core/calibration/CertificateStore.h"
#include "core/exchange/dcc/DccFile.h"
#include "core/session/Origin.h"
#include "core/session/SessionWriter.h"
#include "tests/exchange/ExportSupport.h"
#include "tests/support/Trials.h"

namespace tacto::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;

/// Texts that XML and the schema make difficult.
std::string drawnText(std::mt19937_64& random) {
    const char* const parts[] = {"Lab", "<b>&amp;", "\"Ω µ\"", "ß", "]]>", "a  b", "\x01", "'", "\t", "x\ny"};
    std::string text = "T";
    for (auto i = random() % 4; i > 0; --i) text += std::string(" ") + parts[random() % std::size(parts)];
    return text;
}

json drawnRows(std::mt19937_64& random, bool known) {
    std::uniform_real_distribution<double> unit(0, 1);
    auto rows = json::array();
    for (auto i = 1 + random() % 12; i > 0; --i) {
        const double exponent = std::pow(10, std::floor(-6 + 8 * unit(random)));
        const bool missing = random() % 8 == 0;
        rows.push_back({{"commanded", unit(random) * exponent},
                        {"error", missing ? json() : json((unit(random) - 0.5) * exponent / 100)},
                        {"expanded_uncertainty", known && !missing ? json(unit(random) * exponent / 100) : json()},
                        {"coverage_factor", known ? json(1 + 2 * unit(random)) : json()},
                        {"tolerance", exponent / 50},
                        {"verdict", random() % 3 == 0 ? "indeterminate" : "pass"}});
    }
    return rows;
}

struct DrawnCalibration {
    fs::path path;
    json item, details, evidence;
};

DrawnCalibration drawCalibration(const fs::path& folder, std::uint64_t seed, bool simulated = false,
                                 const char* origin = origin::kHardware, std::string_view verdict = "pass") {
    std::mt19937_64 random(seed);
    DrawnCalibration drawn{folder / fmt::format("calibration-{}.tacto", seed), {}, json::object(), json::object()};
    auto about = someAbout();
    about.protocol = "stimulator-calibration";
    about.simulated = simulated;
    about.devices = {{"pulsepal:/dev/ttyACM0", "stimulator", drawnText(random), "P2 \"1\"", "1.2", simulated, origin},
                     {"sigrok:rigol", "oscilloscope", "Rigol DS1054Z", "DS1ZA1", "", simulated, origin}};
    VirtualClock clock;
    auto session = SessionWriter::create(drawn.path, about, clock).value();
    for (const char* key : {"laboratory", "address", "customer", "make", "authorised_by", "number"})
        if (random() % 2 == 0) drawn.details[key] = drawnText(random);
    auto details = drawn.details;
    details["kind"] = "certificate details";
    EXPECT_TRUE(session->reportItem(clock.now(), details));
    if (random() % 2 == 0) {
        const Certificate certificate{"Rigol DS1054Z",          "DS1ZA1", "K-17", "DAkkS Lab", *parseDate("2026-11-01"),
                                      *parseDate("2027-10-31"), 0.5,      2.0,    {},          {}};
        EXPECT_TRUE(session->event(clock.now(), kCertificateEvent,
                                   {{"text", "certificate K-17 is used"}, {"certificate", toJson(certificate)}}));
    }
    auto quantities = json::array();
    const std::pair<const char*, const char*> known[] = {
        {"amplitude", random() % 2 == 0 ? "V" : "mA"}, {"interval", "s"}, {"width", "s"}, {"gap", "s"}};
    for (std::size_t i = 0; i <= random() % std::size(known); ++i) {
        const auto& [id, unit] = known[i];
        quantities.push_back({{"quantity", id},
                              {"title", drawnText(random)},
                              {"unit", unit},
                              {"warnings", json::array()},
                              {"measured", drawnRows(random, random() % 4 != 0)},
                              {"found", random() % 3 == 0 ? drawnRows(random, true) : json()},
                              {"left", random() % 3 == 0 ? drawnRows(random, true) : json()}});
        if (random() % 2 == 0)
            drawn.evidence[id] = {{"gain", 1.01},
                                  {"gain_expanded_uncertainty", 0.001},
                                  {"gain_coverage_factor", 2.05},
                                  {"offset", -1e-7},
                                  {"offset_expanded_uncertainty", 1e-8},
                                  {"offset_coverage_factor", 1.9599639845400545}};
    }
    if (!drawn.evidence.empty())
        EXPECT_TRUE(session->measurement(clock.now(), kCalibrationMeasurement, drawn.evidence));
    drawn.item = {{"kind", "certificate"},
                  {"quantities", quantities},
                  {"correction_in_readings", json::array()},
                  {"before", {{"text", "not calibrated"}, {"made", json()}}},
                  {"kept", json()}};
    EXPECT_TRUE(session->reportItem(clock.now(), drawn.item));
    if (!verdict.empty())
        EXPECT_TRUE(session->verdict(clock.now(), "stimulator-calibration", verdict, {}, json::object()));
    EXPECT_TRUE(session->close());
    return drawn;
}

Result<ExportReport> exportedDcc(const fs::path& session, const fs::path& out) {
    return exportSession(session, *exportFormat("dcc"), out, "0.0.0-test");
}

/// The rows of an exported table as the session has them, in the order of the certificate.
std::vector<json> tablesOf(const json& item) {
    std::vector<json> all;
    for (const auto& quantity : item["quantities"])
        for (const char* key : {"measured", "found", "left"})
            if (quantity[key].is_array()) all.push_back(quantity[key]);
    return all;
}

bool isSame(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

TEST(DccExport, ComesBackEqual) {
    RecordProperty("hazard", "H9");
    for (std::uint64_t seed = 1; seed <= trials<std::uint64_t>({.local = 30, .ci = 100, .campaign = 3000}); ++seed) {
        const ScratchDir folder;
        const auto drawn = drawCalibration(folder.path(), seed);
        const auto done = exportedDcc(drawn.path, folder.path() / "a.xml");
        ASSERT_TRUE(done) << done.error().message;
        const auto file = readDcc(folder.path() / "a.xml");
        ASSERT_TRUE(file) << file.error().message << " seed " << seed;
        EXPECT_FALSE(file->simulated || file->signature.there);
        EXPECT_EQ(file->begun, "2026-11-20");
        ASSERT_EQ(file->items.size(), 1U);
        EXPECT_EQ(file->items[0].serial, "P2 \"1\"");
        if (drawn.details.contains("laboratory"))
            EXPECT_EQ(file->laboratory, printable(trimmed(drawn.details["laboratory"].get<std::string>())));
        else
            EXPECT_EQ(file->laboratory, "unknown");
        // Quantities with values: four of each table, and two of each line.
        auto next = file->quantities.begin();
        const auto tables = tablesOf(drawn.item);
        ASSERT_EQ(file->quantities.size(), 4 * tables.size() + 2 * drawn.evidence.size()) << "seed " << seed;
        for (const auto& rows : tables) {
            while (next->is("") || !next->is("basic_nominalValue")) ++next;
            const auto &set = next[0], &delivered = next[1], &error = next[2], &tolerance = next[3];
            ASSERT_TRUE(delivered.is("basic_measuredValue") && error.is("basic_measurementError"));
            ASSERT_EQ(error.values.size(), rows.size());
            const bool anyKnown = std::ranges::any_of(rows, [](const json& row) {
                return row["expanded_uncertainty"].is_number() && row["error"].is_number();
            });
            EXPECT_EQ(!error.uncertainties.empty(), anyKnown);
            for (std::size_t i = 0; i < rows.size(); ++i) {
                const double off = numberOr(rows[i], "error"), u = numberOr(rows[i], "expanded_uncertainty");
                // Twelve digits: no 0.6499999999999999.
                EXPECT_EQ(set.values[i], parseNumber(fmt::format("{:.12g}", rows[i]["commanded"].get<double>())));
                EXPECT_TRUE(isSame(error.values[i], off)) << i << " seed " << seed;
                EXPECT_TRUE(isSame(delivered.values[i], numberOr(rows[i], "commanded") + off));
                EXPECT_EQ(tolerance.values[i], rows[i]["tolerance"].get<double>());
                if (!anyKnown) continue;
                EXPECT_TRUE(isSame(error.uncertainties[i], u));
                EXPECT_TRUE(
                    isSame(error.coverageFactors[i], std::isnan(u) ? kNaN : numberOr(rows[i], "coverage_factor")));
                EXPECT_EQ(error.probabilities[i], 0.95);
                EXPECT_TRUE(isSame(delivered.uncertainties[i], u));
            }
            next += 4;
        }
    }
}

TEST(DccExport, SaysWhatItIsAndWhatNobodyKnows) {
    RecordProperty("hazard", "H9");
    const ScratchDir folder;
    const auto real = drawCalibration(folder.path(), 3),
               simulated = drawCalibration(folder.path(), 4, true, origin::kSimulated);
    ASSERT_TRUE(exportedDcc(real.path, folder.path() / "real.xml"));
    const auto done = exportedDcc(simulated.path, folder.path() / "simulated.xml");
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_TRUE(done->simulated);
    const auto textOf = [&](const char* name) {
        const auto bytes = bytesOf(folder.path() / name);
        return std::string(bytes.begin(), bytes.end());
    };
    EXPECT_THAT(textOf("real.xml"), HasSubstr("This file is not signed"));
    EXPECT_THAT(textOf("real.xml"), HasSubstr("the country (ZZ)"));
    EXPECT_THAT(textOf("real.xml"), testing::Not(HasSubstr("SIMULATED")));
    EXPECT_THAT(textOf("simulated.xml"), HasSubstr("SIMULATED: this shows what a certificate would say"));
    EXPECT_TRUE(readDcc(folder.path() / "simulated.xml")->simulated);
    EXPECT_EQ(bytesBelow(folder.path() / "real.xml"),
              (exportedDcc(real.path, folder.path() / "again.xml"), bytesBelow(folder.path() / "again.xml")));
}

TEST(DccExport, IsRefusedWithoutACalibrationThatHolds) {
    RecordProperty("hazard", "H9");
    const ScratchDir folder;
    const auto out = folder.path() / "out" / "a.xml";
    fs::create_directory(out.parent_path());
    const auto refuses = [&](const fs::path& session, const char* why) {
        const auto done = exportedDcc(session, out);
        ASSERT_FALSE(done) << why;
        EXPECT_EQ(done.error().code, ErrorCode::Unsupported);
        EXPECT_THAT(done.error().message, HasSubstr(why));
        EXPECT_TRUE(namesIn(out.parent_path()).empty());
    };
    refuses(drawSession(folder.path(), 1).path, "no new calibration");
    refuses(drawCalibration(folder.path(), 2, false, origin::kHardware, "stopped").path, "verdict");
    refuses(drawCalibration(folder.path(), 3, false, origin::kHardware, "").path, "verdict");
    refuses(drawCalibration(folder.path(), 4, false, origin::kReplayedMeasured).path, "files");
    const auto damaged = drawCalibration(folder.path(), 5);
    forge(damaged.path, "UPDATE entries SET body=replace(body, 'pulsepal', 'pulsepol')");
    refuses(damaged.path, "not what was recorded");
}

TEST(DccExport, LeavesNothingOnAFullDisk) {
    const ScratchDir folder;
    const auto drawn = drawCalibration(folder.path(), 6);
    const auto out = folder.path() / "out" / "a.xml";
    fs::create_directory(out.parent_path());
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    for (const rlim_t most : {rlim_t{0}, rlim_t{1}, rlim_t{4096}}) {
        auto now = before;
        now.rlim_cur = most;
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &now), 0);
        const auto done = exportedDcc(drawn.path, out);
        setrlimit(RLIMIT_FSIZE, &before);
        ASSERT_FALSE(done);
        EXPECT_EQ(done.error().code, ErrorCode::Io);
        EXPECT_TRUE(namesIn(out.parent_path()).empty());
    }
}

/// Exports calibrations and has others' programs compare them, with PTB's schema where it is.
void expectHeldForOthers(const std::string& python, const fs::path& schema, std::uint64_t count) {
    for (std::uint64_t seed = 1; seed <= count; ++seed) {
        const ScratchDir folder;
        const bool simulated = seed % 5 == 0;
        const auto drawn =
            drawCalibration(folder.path(), seed, simulated, simulated ? origin::kSimulated : origin::kHardware);
        ASSERT_TRUE(exportedDcc(drawn.path, folder.path() / "a.xml"));
        folder.write("expected.json", json{{"tables", tablesOf(drawn.item)}, {"evidence", drawn.evidence}}.dump());
        const auto ran = outputOfShell(fmt::format(
            "'{}' '{}' '{}' '{}' '{}'", python, (sourceDir() / "tests/exchange/dcc/read_dcc.py").string(),
            (folder.path() / "a.xml").string(), (folder.path() / "expected.json").string(), schema.string()));
        ASSERT_EQ(ran.code, 0) << ran.text << " seed " << seed;
    }
}
std::optional<std::string> pythonForDcc() {
    return pythonWith("dcc", "lxml, signxml, dcc_json_toolkit", "pydcc dccQuantities lxml");
}

TEST(DccExport, HoldsWhatPydccReads) {
    RecordProperty("hazard", "H9");
    const auto python = pythonForDcc();
    if (!python) GTEST_SKIP() << kNoPackages;
    expectHeldForOthers(*python, {}, trials<std::uint64_t>({.local = 4, .ci = 10, .campaign = 300}));
}

TEST(DccExport, FitsTheSchemaAndHoldsWhatDccQuantitiesReads) {
    RecordProperty("hazard", "H9");
    const auto schema = sharedData("dcc-schema");
    if (!schema) GTEST_SKIP() << kNoSharedData;
    const auto python = pythonForDcc();
    if (!python) GTEST_SKIP() << kNoPackages;
    expectHeldForOthers(*python, *schema, trials<std::uint64_t>({.local = 2, .ci = 6, .campaign = 100}));
}

}  // namespace
}  // namespace tacto::test
