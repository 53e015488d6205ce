// A calibration certificate of the oscilloscope, from the command line to the uncertainties of a run.
#include <chrono>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/Csv.h"
#include "core/exchange/dcc/DccFile.h"
#include "tests/cli/RunCli.h"
#include "tests/cli/Shape.h"
#include "tests/exchange/dcc/DccText.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string daysFromToday(int days) {
    const std::chrono::year_month_day day =
        std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()) + std::chrono::days(days);
    return fmt::format("{:04}-{:02}-{:02}", int(day.year()), unsigned(day.month()), unsigned(day.day()));
}

class CertificateCli : public testing::Test {
protected:
    [[nodiscard]] Ran add(const std::string& serial, const std::string& number, int date, int due,
                          const Words& figures = {"--gain-u", "0.5", "--timebase-u-ppm", "10", "--shunt-u", "0.1",
                                                  "--probe-u", "0.2"}) const {
        Words words{"certificate", "add",  "--instrument", "Scope X", "--serial",          serial,  "--number",
                    number,        "--by", "DAkkS Lab",    "--date",  daysFromToday(date), "--due", daysFromToday(due)};
        words.insert(words.end(), figures.begin(), figures.end());
        return desk.run(words);
    }
    [[nodiscard]] Json list() const {
        const auto ran = desk.run({"certificate", "list", "--json"});
        EXPECT_EQ(ran.code, 0) << ran.err;
        return Json::parse(ran.out, nullptr, false);
    }
    /// Runs load-safety with an oscilloscope that states no accuracy itself.
    [[nodiscard]] Ran loadSafety(std::string_view out = "sessions") const {
        return desk.run({"run", "load-safety", "--device", "sim:oscilloscope?accuracy=unknown", "--device",
                         "sim:", "--seed", "7", "--set", "area=1", "--json", "--out", desk.at(out)});
    }
    [[nodiscard]] static std::string reasonsOf(const Ran& ran) {
        return Json::parse(ran.out, nullptr, false)["results"]["reasons"].dump();
    }
    Desk desk;
};

TEST_F(CertificateCli, IsEnteredListedAndWithdrawn) {
    EXPECT_EQ(list(), Json::array());
    ASSERT_EQ(add("DS1ZA1", "4711", -10, 355).code, 0);
    ASSERT_EQ(add("DS1ZA1", "4000", -400, -35, {"--gain-u", "1"}).code, 0);
    const Json all = list();
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0]["number"], "4711");
    EXPECT_EQ(all[0]["serial"], "DS1ZA1");
    EXPECT_EQ(all[0]["state"], "in use");
    EXPECT_DOUBLE_EQ(all[0]["timebase_u_ppm"].get<double>(), 10);
    EXPECT_EQ(all[1]["state"], "superseded");
    EXPECT_EQ(all[1]["used"], false);
    EXPECT_TRUE(all[1]["probe_u_pct"].is_null());  // an uncertainty that is not stated is not 0
    ASSERT_EQ(desk.run({"certificate", "withdraw", "4711"}).code, 0);
    EXPECT_EQ(list()[0]["state"], "withdrawn");
    EXPECT_EQ(list()[0]["withdrawn"], daysFromToday(0));
    const auto shown = desk.run({"certificate", "list"});
    EXPECT_THAT(shown.out, HasSubstr("certificate 4000"));
    EXPECT_THAT(shown.out, HasSubstr("expired, not used"));
    expectRefused(desk.run({"certificate", "withdraw", "4711"}), 3, {"4711", "does not exist or is withdrawn"});
}

TEST_F(CertificateCli, IsRefusedInOneSentence) {
    RecordProperty("hazard", "H9");
    expectRefused(desk.run({"certificate"}), 2, {"list, add or withdraw"});
    expectRefused(desk.run({"certificate", "renew"}), 2, {"renew", "withdraw"});
    expectRefused(desk.run({"certificate", "withdraw"}), 2, {"NUMBER"});
    expectRefused(desk.run({"certificate", "list", "--gain-u", "1"}), 2, {"--gain-u"});
    expectRefused(add("", "1", 0, 9), 2, {"serial number is empty"});
    expectRefused(add("A", "", 0, 9), 2, {"certificate number is empty"});
    expectRefused(add("A", "1", 0, -1), 2, {"before its date"});
    expectRefused(add("A", "1", 0, 9, {}), 2, {"--gain-u is missing"});
    for (const auto* u : {"nan", "0", "-1", "51", "1e999", "1,000"})
        expectRefused(add("A", "1", 0, 9, {"--gain-u", u}), 2, {});
    expectRefused(desk.run({"certificate", "add", "--instrument", "X", "--serial", "A", "--number", "1", "--by", "L",
                            "--date", "2026-02-30", "--due", "2027-01-01", "--gain-u", "1"}),
                  2, {"--date", "2026-02-30"});
    EXPECT_EQ(list(), Json::array());
}

TEST_F(CertificateCli, ADamagedFileIsNamedAndNothingOfItIsUsed) {
    RecordProperty("hazard", "H9");
    ASSERT_EQ(add("SIM-7", "4711", -10, 355).code, 0);
    const auto home = desk.environment();
    std::string file;
    for (const auto& line : home)
        if (line.starts_with("XDG_DATA_HOME=")) file = line.substr(14) + "/tactoscope/certificates.jsonl";
    auto text = contentOf(file);
    const auto at = text.find("\"gain_u_pct\":0.5");
    ASSERT_NE(at, std::string::npos);
    std::ofstream(file) << text.replace(at, 16, "\"gain_u_pct\":0.1");
    expectRefused(desk.run({"certificate", "list"}), 3, {"certificates.jsonl:1", "digest"});
    expectRefused(add("SIM-7", "4712", -10, 355), 3, {"certificates.jsonl:1", "digest"});
    const auto ran = loadSafety();
    EXPECT_EQ(ran.code, 5);
    EXPECT_THAT(ran.err, HasSubstr("no certificate is used"));
    EXPECT_THAT(reasonsOf(ran), HasSubstr("the oscilloscope does not state the gain of voltage"));
}

TEST_F(CertificateCli, LoadSafetyTakesItsUncertaintyFromIt) {
    RecordProperty("hazard", "H9");
    const auto without = loadSafety();
    EXPECT_EQ(without.code, 5);
    EXPECT_THAT(reasonsOf(without), HasSubstr("the oscilloscope does not state the gain of voltage"));
    ASSERT_EQ(add("SIM-7", "4711", -10, 355).code, 0);
    const auto with = loadSafety("with");
    EXPECT_EQ(with.code, 0) << reasonsOf(with);
    EXPECT_THAT(with.err, Not(HasSubstr("certificate")));
    const Json result = Json::parse(with.out, nullptr, false);
    int looked = 0;
    for (const auto& load : result["results"]["loads"]) {
        if (load["name"] != "1 kohm") continue;
        // The standard uncertainties of the gain (0.25 %) and the probe (0.1 %), and little else.
        const double relative = load["peak_v_u"].get<double>() / load["peak_v"].get<double>();
        EXPECT_GT(relative, 0.00269);
        EXPECT_LT(relative, 0.0035);
        ++looked;
    }
    EXPECT_EQ(looked, 1);
    const auto captures = desk.named("with", ".csv");
    ASSERT_FALSE(captures.empty());
    const auto text = contentOf(desk.path() / captures.front());
    EXPECT_THAT(text.substr(0, text.find("\n1.")), HasSubstr("gain, probe: certificate 4711 (DAkkS Lab, " +
                                                             daysFromToday(-10) + ", due " + daysFromToday(355) + ")"));
}

TEST_F(CertificateCli, OneOfTheGainAloneLeavesTheRestUnknown) {
    RecordProperty("hazard", "H9");
    ASSERT_EQ(add("SIM-7", "4711", -10, 355, {"--gain-u", "0.5"}).code, 0);
    const auto ran = loadSafety();
    EXPECT_EQ(ran.code, 5);
    EXPECT_THAT(reasonsOf(ran), HasSubstr("does not state the probe of voltage, the shunt of current, the time base"));
}

TEST_F(CertificateCli, OneThatIsExpiredOrOfTheFutureOrOfAnotherIsNotUsed) {
    RecordProperty("hazard", "H9");
    const auto unused = [&](const char* why) {
        const auto ran = loadSafety();
        EXPECT_EQ(ran.code, 5) << why;
        EXPECT_THAT(reasonsOf(ran), HasSubstr("does not state the gain of voltage")) << why;
        return ran.err;
    };
    ASSERT_EQ(add("SIM-8", "other", -10, 355).code, 0);
    EXPECT_THAT(unused("another serial"), Not(HasSubstr("certificate")));
    const auto future = add("SIM-7", "next", 2, 355);
    EXPECT_THAT(future.err, HasSubstr("dated in the future"));
    EXPECT_THAT(unused("future"), HasSubstr("is dated in the future: its figures are not used"));
    EXPECT_THAT(add("SIM-7", "last", -355, -2).err, HasSubstr("It is expired"));
    EXPECT_THAT(unused("expired"), HasSubstr("certificate last (DAkkS Lab, " + daysFromToday(-355) + ", due " +
                                             daysFromToday(-2) + ") of the oscilloscope SIM-7 is expired"));
}

TEST_F(CertificateCli, IsReadFromADigitalOne) {
    RecordProperty("hazard", "H9");
    DccText dcc;
    dcc.ended = daysFromToday(-10);
    dcc.due = "";
    dcc.results = dccResult("DC", dccReal("", "Gain error", "0.1", "\\percent", "0.5", "2"));
    const auto file = desk.at("scope.xml");
    const auto save = [&](const DccText& as) { std::ofstream(file) << as.text(); };
    save(dcc);
    expectRefused(desk.run({"certificate", "add", "--dcc", file}), 3, {"K-17", "day on which it is due"});
    const auto added = desk.run({"certificate", "add", "--dcc", file, "--due", daysFromToday(300), "--json"});
    ASSERT_EQ(added.code, 0) << added.err;
    const Json one = Json::parse(added.out, nullptr, false);
    expectKeys(one,
               {"instrument", "serial", "number", "by", "date", "due", "gain_u_pct", "timebase_u_ppm", "shunt_u_pct",
                "probe_u_pct", "state", "used", "entered", "withdrawn", "notes"},
               "certificate add --dcc");
    EXPECT_DOUBLE_EQ(one["gain_u_pct"].get<double>(), 0.6);
    EXPECT_EQ(one["used"], true);
    EXPECT_THAT(one["notes"].dump(), HasSubstr("certificate K-17 is unsigned"));
    EXPECT_EQ(list()[0]["number"], "K-17");
    dcc.number = "K-18";
    dcc.results = dccResult("DC", dccReal("", "Gain error", "NaN", "\\percent", "0.5", "2"));
    save(dcc);
    expectRefused(desk.run({"certificate", "add", "--dcc", file, "--due", daysFromToday(300)}), 3, {"K-18", "NaN"});
    expectRefused(desk.run({"certificate", "add", "--dcc", desk.at("none.xml")}), 3, {"none.xml"});
    expectRefused(desk.run({"certificate", "add", "--dcc", file, "--due", "soon"}), 2, {"--due", "soon"});
    EXPECT_EQ(list().size(), 1U);
}

TEST_F(CertificateCli, OfAStimulatorGoesOutAsADigitalOne) {
    RecordProperty("hazard", "H9");
    const auto ran = desk.run({"run", "stimulator-calibration", "--device", "sim:", "--seed", "3", "--set", "store=yes",
                               "--report", "none", "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto session = Json::parse(ran.out, nullptr, false)["session"].get<std::string>();
    const auto out = desk.at("a.xml");
    const auto done = desk.run({"export", session, "--format", "dcc", "--out", out, "--json"});
    ASSERT_EQ(done.code, 0) << done.err;
    const Json said = Json::parse(done.out, nullptr, false);
    EXPECT_EQ(said["format"], "dcc");
    EXPECT_EQ(said["simulated"], true);
    EXPECT_EQ(said["files"][0]["path"], "a.xml");
    const auto file = readDcc(out);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_TRUE(file->simulated);
    EXPECT_EQ(file->items[0].serial, "SIM-3");
    expectRefused(desk.run({"certificate", "add", "--dcc", out}), 3, {"simulated bench"});
    // By the stimulator whose calibration is stored.
    ASSERT_EQ(desk.run({"export", "SIM-3", "--format", "dcc", "--out", desk.at("b.xml")}).code, 0);
    EXPECT_EQ(readTextFile(desk.at("b.xml")).value_or("none"), readTextFile(out).value_or(""));
    expectRefused(desk.run({"export", "SIM-4", "--format", "dcc", "--out", desk.at("c.xml")}), 3,
                  {"no calibration of a stimulator SIM-4"});
    std::filesystem::remove(session);
    expectRefused(desk.run({"export", "SIM-3", "--format", "dcc", "--out", desk.at("c.xml")}), 3,
                  {"SIM-3", std::filesystem::path(session).filename().string(), "its path is expected"});
    EXPECT_FALSE(std::filesystem::exists(desk.at("c.xml")));
}

}  // namespace
}  // namespace tacto::test
