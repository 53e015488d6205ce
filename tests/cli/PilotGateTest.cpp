// The gates of a study before a session, as a user meets them: each gives one sentence and an exit code, no option
// bypasses it, and the study's folder stays the same, byte for byte.
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/PilotDesk.h"

namespace tacto::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

class PilotGates : public testing::Test {
protected:
    void SetUp() override {
        study({"create", at(), "--title", "Four conditions", "--approval", "EC-17", "--from", "2026-01-01", "--expires",
               "2099-12-31", "--consent-version", "2"});
        code = enrolled({"--virtual", "7"});
    }
    [[nodiscard]] std::string at() const { return desk.desk().at("study"); }
    Ran study(Words words) const {
        const auto ran = desk.desk().run(Words{"study"} + words + Words{"--passphrase-file", passphrase, "--json"});
        EXPECT_EQ(ran.code, 0) << ran.err;
        return ran;
    }
    [[nodiscard]] std::string enrolled(const Words& more) const {
        return jsonOf(study(Words{"enrol", at()} + more))["code"].get<std::string>();
    }
    void consents() const { study({"consent", at(), code, "--version", "2", "--date", "2026-11-20", "--by", "KL"}); }
    /// `whose` and `more` are arguments of `run`.
    void expectRefused(const std::string& whose, int exit, const char* says, const Words& more = {},
                       std::chrono::seconds clock = 0s) const {
        SCOPED_TRACE(says);
        const auto before = desk.desk().files("study");
        const auto ran =
            desk.runDisturbed({.clock = clock}, "pilot-thresholds",
                              Words{"--set", "participant=" + whose, "--passphrase-file", passphrase} + more);
        EXPECT_EQ(ran.code, exit) << ran.err;
        EXPECT_THAT(ran.err, HasSubstr(says));
        EXPECT_EQ(std::ranges::count(ran.err, '\n'), 1) << ran.err;
        EXPECT_EQ(ran.out, "");
        EXPECT_TRUE(desk.desk().files("study") == before) << "bytes of the study were changed";
    }
    /// Replaces bytes in a file of the study, expects the refusal, and restores the bytes.
    void expectRefusedWith(const char* file, const std::string& was, const std::string& is, int exit,
                           const char* says) const {
        const auto path = desk.desk().at(file);
        const auto whole = contentOf(path);
        auto changed = whole;
        const auto place = changed.find(was);
        ASSERT_NE(place, std::string::npos) << was;
        changed.replace(place, was.size(), is);
        std::ofstream(path, std::ios::binary) << changed;
        expectRefused(code, exit, says);
        std::ofstream(path, std::ios::binary) << whole;
    }

    const PilotDesk desk;
    const std::string passphrase = desk.desk().write("passphrase", "correct horse 4711\n");
    std::string code;
};

TEST_F(PilotGates, OfRecordApprovalAndMachineRefuseWithNothingChanged) {
    RecordProperty("hazard", "H11");
    consents();
    expectRefused(code, 4, "expired on 2099-12-31", {}, 24h * 365 * 100);
    expectRefused(code, 4, "set the clock", {}, -24h);
    expectRefused(code, 4, "the number of blocks is the study's", {"--set", "blocks=1"});
    expectRefused(code, 4, "modality is massager; electrodes", {"--set", "modality=massager"});
    expectRefusedWith("study/study.json", "\"version\": 1", "\"version\": 2", 3, "made by a newer Tactoscope");
    expectRefusedWith("study/study.json", "\"cap_ma\": 15", "\"cap_ma\": 14", 3, "study.json");
    const auto ledger = contentOf(desk.desk().at("study/ledger.tacto"));
    const auto seal = ledger.find("\"sealed\":\"");
    ASSERT_NE(seal, std::string::npos);
    const auto was = ledger.substr(seal, 80);
    auto is = was;
    is[60] = is[60] == 'A' ? 'B' : 'A';
    expectRefusedWith("study/ledger.tacto", was, is, 3, "the ledger of the study in");
    study({"amend", at(), "--reference", "EC-17 A1", "--from", "2098-01-01"});
    expectRefused(code, 4, "begins on 2098-01-01");
}

TEST_F(PilotGates, OfParticipantConsentAndExclusionRefuseWithNothingChanged) {
    RecordProperty("hazard", "H12");
    expectRefused(code, 4, "has given no consent");
    consents();
    auto slipped = code;
    slipped.back() = slipped.back() == '7' ? '8' : '7';
    expectRefused(slipped, 3, "its check character is wrong");
    expectRefused(code == "P-7K3D" ? "P-ZZZZ" : "P-7K3D", 3, "the study has no participant");
    expectRefused("virtual:8", 3, "virtual:8");
    expectRefused(code, 4, "exclusion checklist", {"--set", "exclusions=epilepsy"});
    const auto person = enrolled({});
    expectRefused(person, 3, "is a person, who needs the window");
    study({"leave", at(), code});
    expectRefused(code, 4, "has left the study");
    study({"withdraw", at(), code, "--confirm", code});
    expectRefused(code, 3, "the study has no participant");
}

TEST_F(PilotGates, OfTheProcedureRefuseAProfileThatIsAnotherInAnythingThatIsFelt) {
    RecordProperty("hazard", "H12");
    consents();
    const auto shipped = nlohmann::json::parse(contentOf(sourceDir() / "resources/encodings/default.json"));
    const auto changed = [&](const char* pointer, const nlohmann::json& value) {
        auto other = shipped;
        other[nlohmann::json::json_pointer(pointer)] = value;
        return desk.desk().write("other.json", other.dump());
    };
    const struct {
        const char* pointer;
        nlohmann::json value;
        const char* says;
    } kChanges[] = {{"/encoding/interval_min_s", 0.4, "shortest interval is 0.4 s"},
                    {"/encoding/interval_max_s", 3, "longest interval is 3 s"},
                    {"/encoding/conditions/0/R", 0.2, "conditions, assignment"},
                    {"/encoding/conditions/3/P", 0.9, "conditions, assignment"},
                    {"/encoding/conditions/1/name", "smooth-firm", "conditions, assignment"},
                    {"/encoding/assignment", "swapped", "conditions, assignment"},
                    {"/encoding/polarity", "negative", "conditions, assignment"},
                    {"/encoding/rate_hz", 120, "conditions, assignment"},
                    {"/safety/load_low_ohm", 600, "conditions, assignment"},
                    {"/safety/load_high_ohm", 9000, "conditions, assignment"},
                    {"/safety/ceilings", {{"peak_current", 12}}, "conditions, assignment"}};
    for (const auto& each : kChanges) {
        SCOPED_TRACE(each.pointer);
        expectRefused(code, 4, each.says, {"--profile", changed(each.pointer, each.value)});
    }
    expectRefused(code, 4, "the method of detection is staircase", {"--set", "method=staircase"});
    // The same profile at another path, or with changes that nobody feels, is not another procedure.
    const auto ran = desk.run("pilot-thresholds", {"--set", "participant=" + code, "--passphrase-file", passphrase,
                                                   "--profile", changed("/name", "by another path")});
    EXPECT_TRUE(ran.code == 0 || ran.code == 5) << ran.err;
}

TEST_F(PilotGates, OfTheProcedureRefuseASessionThatWouldGoOnAfterAnAmendmentOfWhatIsFelt) {
    RecordProperty("hazard", "H6");
    consents();
    const Words words{"--set", "participant=" + code, "--passphrase-file", passphrase};
    ASSERT_EQ(desk.runKilled(120, "pilot-thresholds", words), -9);
    study({"amend", at(), "--reference", "EC-17 A1", "--set", "train.width_us=400"});
    const auto before = jsonOf(study({"show", at()}));  // rows instead of bytes, because reading merges the journal
    const auto refused = desk.run("pilot-thresholds", words + Words{"--set", "unfinished=resume"});
    EXPECT_EQ(refused.code, 4) << refused.err;
    EXPECT_THAT(refused.err, HasSubstr("it goes on with the former, or ends with --set unfinished=end"));
    EXPECT_EQ(jsonOf(study({"show", at()})), before);
    study({"amend", at(), "--reference", "EC-17 A2", "--set", "train.width_us=200", "--expires", "2098-12-31"});
    const auto ran = desk.run("pilot-thresholds", words + Words{"--set", "unfinished=resume"});
    EXPECT_TRUE(ran.code == 0 || ran.code == 5) << ran.err << " a later day changes nothing that is felt";
}

TEST(PilotRehearsal, IsNotGoneOnWithUnderAnotherProfile) {
    RecordProperty("hazard", "H6");
    const PilotDesk desk;
    ASSERT_EQ(desk.runKilled(120, "pilot-thresholds", {"--set", "participant=virtual:7"}), -9);
    auto other = nlohmann::json::parse(contentOf(sourceDir() / "resources/encodings/default.json"));
    other["encoding"]["interval_max_s"] = 3;  // no level of a threshold uses this interval
    const auto shown = [&] { return desk.desk().run({"study", "show", desk.desk().at("study"), "--json"}).out; };
    const auto before = shown();
    const auto ran = desk.run("pilot-thresholds", {"--set", "participant=virtual:7", "--set", "unfinished=resume",
                                                   "--profile", desk.desk().write("other.json", other.dump())});
    EXPECT_EQ(ran.code, 4) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("was begun with a profile, method and settings that hash to"));
    EXPECT_EQ(shown(), before);
}

TEST_F(PilotGates, OfThePassphraseRefuseWithNothingChanged) {
    RecordProperty("hazard", "H11");
    const auto before = desk.desk().files("study");
    const auto with = [&](const Words& more) {
        return desk.run("pilot-thresholds", Words{"--set", "participant=" + code} + more);
    };
    auto ran = with({"--passphrase-file", desk.desk().write("wrong", "correct horse 4712\n")});
    EXPECT_EQ(ran.code, 3) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("does not open the key file"));
    ran = with({});
    EXPECT_EQ(ran.code, 3) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("--passphrase-file is expected"));
    EXPECT_TRUE(desk.desk().files("study") == before);
}

TEST_F(PilotGates, AnApprovalThatEndsWhileASessionRunsEndsItBeforeItsNextBlockAndForGood) {
    RecordProperty("hazard", "H11");
    consents();
    const Words words{"--set", "participant=" + code, "--passphrase-file", passphrase};
    const auto later = 24h * 365 * 100;
    const auto ran = desk.runDisturbed({.clock = later, .clockFromSync = 60}, "pilot-identification", words);
    EXPECT_EQ(ran.code, 4) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("expired on 2099-12-31"));
    const auto shown = jsonOf(study({"show", at()}));
    ASSERT_EQ(shown["sessions"].size(), 1U);
    EXPECT_EQ(shown["sessions"][0]["state"], "stopped");
    const auto before = desk.desk().files("study");
    const auto again =
        desk.runDisturbed({.clock = later}, "pilot-identification", words + Words{"--set", "unfinished=resume"});
    EXPECT_EQ(again.code, 4) << again.err;
    EXPECT_THAT(again.err, HasSubstr("expired on 2099-12-31"));
    EXPECT_TRUE(desk.desk().files("study") == before);
}

}  // namespace
}  // namespace tacto::test
