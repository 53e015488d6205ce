// export SESSION: its JSON, its exit codes, and that it agrees with the session that it came from.
#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "core/base/Csv.h"
#include "core/exchange/Export.h"
#include "tests/cli/Shape.h"
#include "tests/support/PythonEnvironment.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class SessionExport : public testing::Test {
protected:
    void SetUp() override {
        const auto ran = desk_.run({"run", "live", "--device", "sim:", "--set", "duration=5", "--out", at("run"),
                                    "--report", "none", "--json"});
        ASSERT_EQ(ran.code, 0) << ran.err;
        session_ = jsonOf(ran).at("session").get<std::string>();
    }
    [[nodiscard]] std::string at(const std::string& name) const { return (desk_.path() / name).string(); }
    const Desk desk_;
    std::string session_;
};

TEST_F(SessionExport, SaysWhatEachFormatHolds) {
    RecordProperty("hazard", "H9");
    for (const auto* format : exportFormats()) {
        const std::string name(format->name);
        const auto ran = desk_.run({"export", session_, "--format", name, "--out", at(name), "--json"});
        ASSERT_EQ(ran.code, 0) << name << ": " << ran.err;
        const auto said = jsonOf(ran);
        expectKeys(said,
                   {"format", "out", "session", "chain_head", "simulated", "marks", "files", "streams", "left_out"},
                   name);
        EXPECT_EQ(said.at("format"), name);
        EXPECT_EQ(said.at("simulated"), true);
        EXPECT_THAT(said.at("marks").dump(), HasSubstr("\"simulated\"")) << name;
        EXPECT_EQ(said.at("chain_head"), jsonOf(desk_.run({"verify", session_, "--json"})).at("head"));
        ASSERT_FALSE(said.at("files").empty());
        for (const auto& file : said.at("files")) {
            const auto path =
                fs::is_directory(at(name)) ? at(name + "/" + file.at("path").get<std::string>()) : at(name);
            EXPECT_EQ(fs::file_size(path), file.at("bytes").get<std::uintmax_t>()) << path;
            EXPECT_EQ(file.at("sha256").get<std::string>().size(), 64U);
        }
        for (const auto& stream : said.at("streams")) {
            expectKeys(stream,
                       {"name", "samples", "rate_hz", "gaps", "repeated", "dropped", "time_error_max_s", "channels"},
                       name);
            for (const auto& channel : stream.at("channels"))
                expectKeys(channel, {"name", "unit", "exact", "step", "max_error", "absent"}, name);
        }
        for (const auto& left : said.at("left_out")) expectKeys(left, {"what", "why"}, name);
    }
}

TEST_F(SessionExport, RefusesWithTheRightCodeAndLeavesNothing) {
    expectRefused(desk_.run({"export", session_, "--format", "xls", "--out", at("x")}), 2, {"\"xls\"", "csv, hdf5"});
    expectRefused(desk_.run({"export", session_, "--format", "csv"}), 2, {"--out is missing"});
    expectRefused(desk_.run({"export", at("nowhere"), "--format", "csv", "--out", at("x")}), 3, {"nowhere"});
    std::ofstream(at("notes.tacto")) << "no session";
    expectRefused(desk_.run({"export", at("notes.tacto"), "--format", "csv", "--out", at("x")}), 3, {"notes.tacto"});
    std::ofstream(at("mine")) << "mine";
    expectRefused(desk_.run({"export", session_, "--format", "hdf5", "--out", at("mine")}), 3, {"exists already"});
    EXPECT_EQ(readTextFile(at("mine")).value_or(""), "mine");
    EXPECT_FALSE(fs::exists(at("x")));
}

TEST_F(SessionExport, ADamagedSessionEndsWith1AndIsMarked) {
    RecordProperty("hazard", "H8");
    std::fstream file(session_, std::ios::in | std::ios::out | std::ios::binary);
    const auto size = fs::file_size(session_);
    file.seekp(static_cast<std::streamoff>(size * 3 / 4));
    file.write(std::string(3000, 'x').data(), 3000);
    file.close();
    ASSERT_EQ(desk_.run({"verify", session_}).code, 1);
    const auto ran = desk_.run({"export", session_, "--format", "csv", "--out", at("out"), "--json"});
    EXPECT_EQ(ran.code, 1) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("DAMAGED"));
    EXPECT_THAT(jsonOf(ran).at("marks").dump(), HasSubstr("damaged"));
    EXPECT_THAT(readTextFile(at("out/session.json")).value_or(""), HasSubstr("\"damaged\": true"));
}

TEST_F(SessionExport, GivesTheSessionsRoughness) {
    ASSERT_EQ(desk_.run({"export", session_, "--format", "csv", "--out", at("out")}).code, 0);
    const auto felt = desk_.run({"roughness", at("out"), "--out", at("frames.csv")});
    ASSERT_EQ(felt.code, 0) << felt.err;
    // The frames of the session, as it felt them while it ran, against those of its exported samples.
    std::ifstream recorded(at("out/frames.csv")), again(at("frames.csv"));
    std::string row, other;
    std::getline(recorded, row);
    std::getline(again, other);
    std::size_t rows = 0;
    for (; std::getline(recorded, row) && std::getline(again, other); ++rows) {
        std::vector<std::string_view> cells, others;
        cutLine(row, ',', cells);
        cutLine(other, ',', others);
        ASSERT_EQ(cells.size(), 10U);
        for (const auto& [here, there] : {std::pair(0, 0), std::pair(3, 3), std::pair(4, 4), std::pair(5, 5)}) {
            const auto one = std::string(cells[std::size_t(here)]), two = std::string(others[std::size_t(there)]);
            if (one.empty() || two.empty())
                EXPECT_EQ(one, two) << row << " / " << other;
            else
                EXPECT_NEAR(std::stod(one), std::stod(two), 1e-6 + 1e-6 * std::abs(std::stod(two)));
        }
    }
    EXPECT_GT(rows, 100U);
}

TEST_F(SessionExport, FromBidsAloneEveryTrainIsComputedAgain) {
    RecordProperty("hazard", "H9");
    const auto script = (sourceDir() / "tests/exchange/recompute_trains.py").string();
    const auto computed = [&](const std::string& session, const std::string& out) {
        const auto ran = desk_.run({"export", session, "--format", "bids", "--out", at(out)});
        EXPECT_EQ(ran.code, 0) << ran.err;
        const auto again = outputOfShell("python3 '" + script + "' '" + at(out) + "'");
        EXPECT_EQ(again.code, 0) << again.text;
        std::array<int, 3> counts{};  // trains, those that the fingertip drove, trials compared
        std::istringstream(again.text) >> counts[0] >> counts[1] >> counts[2];
        return counts;
    };
    const auto live = computed(session_, "live");
    EXPECT_GT(live[0], 2);
    EXPECT_EQ(live[1], live[0]) << "each was driven by the fingertip";
    const auto ran = desk_.run({"run", "separability", "--device", "sim:", "--set", "repeats=3", "--out", at("trials"),
                                "--report", "none", "--json"});
    ASSERT_EQ(ran.code, 5) << ran.err;  // too few trials for a verdict
    const auto measured = computed(jsonOf(ran).at("session").get<std::string>(), "measured");
    EXPECT_GE(measured[0], 24);
    EXPECT_EQ(measured[2], 12) << "each trial's means are those of its trains";
}

TEST_F(SessionExport, CtrlCLeavesNothing) {
    const auto ran = desk_.run({"run", "live", "--device", "sim:", "--set", "duration=600", "--out", at("long"),
                                "--report", "none", "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    fs::create_directory(at("place"));
    auto started = desk_.start(
        {"export", jsonOf(ran).at("session").get<std::string>(), "--format", "csv", "--out", at("place/out")});
    ASSERT_TRUE(started.waitUntil([&] { return !fs::is_empty(at("place")); }));
    started.signal(SIGINT);
    EXPECT_EQ(started.wait().code, 4);
    EXPECT_TRUE(fs::is_empty(at("place")));
}

TEST(StudySessionExport, NeedsTheStudyAndSaysNoCode) {
    RecordProperty("hazard", "H11");
    const Desk desk;
    const auto at = [&](const std::string& name) { return (desk.path() / name).string(); };
    const auto passphrase = desk.write("passphrase", "correct horse 4711\n");
    const auto study = [&](Words words) {
        words.insert(words.begin(), "study");
        words.insert(words.end(), {"--passphrase-file", passphrase, "--json"});
        const auto ran = desk.run(words);
        EXPECT_EQ(ran.code, 0) << ran.err;
        return ran;
    };
    study({"create", at("study"), "--title", "Four conditions", "--approval", "EC-17", "--from", "2026-01-01",
           "--expires", "2099-12-31", "--consent-version", "2", "--set", "blocks=1"});
    const auto code = jsonOf(study({"enrol", at("study"), "--virtual", "7"}))["code"].get<std::string>();
    study({"consent", at("study"), code, "--version", "2", "--date", "2026-11-20", "--by", "K. Beispiel"});
    // As a person's: by the code, which the session then keeps as a parameter.
    const auto ran = desk.run({"run", "pilot-identification", "--device", "sim:", "--out", at("study"), "--set",
                               "participant=" + code, "--operator", "beside " + code, "--seed", "3",
                               "--passphrase-file", passphrase, "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto session = jsonOf(ran).at("session").get<std::string>();
    auto plain = code;
    std::erase(plain, '-');
    expectRefused(desk.run({"export", session, "--format", "csv", "--out", at("study/out")}), 3,
                  {"lies inside the study folder"});
    for (const auto* format : exportFormats()) {
        const std::string name(format->name);
        const auto done = desk.run({"export", session, "--format", name, "--out", at("as-" + name), "--passphrase-file",
                                    passphrase, "--json"});
        ASSERT_EQ(done.code, 0) << name << ": " << done.err;
    }
    const auto files = desk.files(".");
    std::size_t exported = 0;
    for (const auto& [file, bytes] : files) {
        if (file.find("as-") == file.npos) continue;
        ++exported;
        for (const auto& said : {code, plain}) EXPECT_EQ(bytes.find(said), bytes.npos) << said << " stands in " << file;
    }
    EXPECT_GT(exported, exportFormats().size());
    // The study is found however its session is named.
    fs::create_symlink(session, at("link.tacto"));
    const auto folder = fs::path(session).parent_path(), file = fs::path(session).filename();
    for (const auto& named :
         {folder / "." / file, folder / ".." / folder.filename() / file, fs::path(at("link.tacto"))}) {
        fs::remove_all(at("again"));
        const auto done = desk.run(
            {"export", named.string(), "--format", "csv", "--out", at("again"), "--passphrase-file", passphrase});
        EXPECT_EQ(done.code, 0) << named << ": " << done.err;
    }
    // Away from its study a sealed session opens for nobody.
    fs::copy_file(session, at("away.tacto"));
    expectRefused(desk.run({"export", at("away.tacto"), "--format", "csv", "--out", at("x")}), 3, {"sealed"});
    EXPECT_FALSE(fs::exists(at("x")));
}

}  // namespace
}  // namespace tacto::test
