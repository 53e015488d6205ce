// export STUDY and report STUDY: which data leave a study, and which never do.
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <regex>

#include "core/base/Csv.h"
#include "tests/cli/Shape.h"

namespace tacto::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// A rehearsal with one session of one block.
class StudyExport : public testing::Test {
protected:
    void SetUp() override {
        const auto ran = desk_.run({"run", "pilot-identification", "--device", "sim:", "--out", study(), "--set",
                                    "participant=virtual:7", "--set", "blocks=1", "--seed", "3", "--json"});
        ASSERT_EQ(ran.code, 0) << ran.err;
        run_ = jsonOf(ran).at("results");
    }
    [[nodiscard]] std::string study() const { return (desk_.path() / "study").string(); }
    [[nodiscard]] std::string at(const char* name) const { return (desk_.path() / name).string(); }

    const Desk desk_;
    Json run_;
};

TEST_F(StudyExport, ABidsFolderHoldsTheSessionsAnswersAndNoCode) {
    RecordProperty("hazard", "H11");
    const auto ran = desk_.run({"export", study(), "--format", "bids", "--out", at("bids")});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto code = run_.at("participant").at("code").get<std::string>();
    std::size_t files = 0, answers = 0;
    static const std::regex date(R"((19|20)\d\d-\d\d-\d\d|\d\d:\d\d)");
    for (const auto& entry : fs::recursive_directory_iterator(at("bids"))) {
        if (!entry.is_regular_file()) continue;
        ++files;
        const auto text = readTextFile(entry.path()).value_or("");
        EXPECT_THAT(text, Not(HasSubstr(code))) << entry.path();
        EXPECT_FALSE(std::regex_search(text, date)) << entry.path();
        if (!entry.path().string().ends_with("task-identification_beh.tsv")) continue;
        for (auto test = text.find("\ttest\t"); test != std::string::npos; test = text.find("\ttest\t", test + 1))
            ++answers;
    }
    EXPECT_GE(files, 10U);
    EXPECT_EQ(answers, run_.at("n").get<std::size_t>() + run_.at("catch").at("n").get<std::size_t>());
    EXPECT_THAT(readTextFile(fs::path(at("bids")) / "dataset_description.json").value_or(""), HasSubstr("simulated"));
    // analyze accepts the table of the export.
    const auto again = desk_.run({"export", study(), "--format", "bids", "--out", at("again")});
    ASSERT_EQ(again.code, 0) << again.err;
    for (const auto& entry : fs::recursive_directory_iterator(at("again"))) {
        if (!entry.path().string().ends_with("task-identification_beh.tsv")) continue;
        const auto analysed = jsonOf(desk_.run({"analyze", "identification", entry.path().string(), "--json"}));
        EXPECT_EQ(analysed.at("n"), run_.at("n"));
        EXPECT_EQ(analysed.at("hits"), run_.at("hits"));
        EXPECT_TRUE(fs::exists(at("bids") / fs::relative(entry.path(), at("again"))));  // the labels are the same
    }
}

TEST_F(StudyExport, NothingIsPutIntoTheStudyFolder) {
    RecordProperty("hazard", "H11");
    expectRefused(desk_.run({"export", study(), "--format", "bids", "--out", study() + "/bids"}), 3,
                  {"lies inside the study folder"});
    expectRefused(desk_.run({"report", study(), "--out", study() + "/report.pdf"}), 3,
                  {"lies inside the study folder"});
    EXPECT_FALSE(fs::exists(study() + "/bids"));
    EXPECT_FALSE(fs::exists(study() + "/report.pdf"));
    expectRefused(desk_.run({"export", study(), "--format", "xml", "--out", at("x")}), 2, {"bids is accepted"});
    expectRefused(desk_.run({"export", study(), "--format", "bids", "--out", at("x"), "--with", "name"}), 2,
                  {"age, sex and handedness"});
    expectRefused(desk_.run({"export", at("nowhere"), "--format", "bids", "--out", at("x")}), 3, {"no study"});
}

TEST_F(StudyExport, ASessionWhoseRecordIsGoneIsNotExportedAsOneWithoutAnswers) {
    RecordProperty("hazard", "H9");
    for (const auto& session : desk_.named("study/sessions", ".tacto")) fs::remove(desk_.path() / session);
    for (const Words& words : {Words{"export", study(), "--format", "bids", "--out", at("bids")},
                               Words{"report", study(), "--out", at("report.pdf")}}) {
        const auto ran = desk_.run(words);
        EXPECT_EQ(ran.code, 3) << ran.err;
        EXPECT_EQ(std::ranges::count(ran.err, '\n'), 1) << ran.err;
        EXPECT_THAT(ran.err, HasSubstr(".tacto"));
    }
    EXPECT_FALSE(fs::exists(at("bids")));
    EXPECT_FALSE(fs::exists(at("report.pdf")));
}

TEST_F(StudyExport, AnAdverseEventIsCountedByEverybodyAndReadByTheCommittee) {
    RecordProperty("hazard", "H12");
    const auto session =
        jsonOf(desk_.run({"study", "show", study(), "--json"})).at("sessions").at(0).at("id").get<std::string>();
    const auto noted =
        desk_.run({"study", "adverse-event", study(), session, "--what", "burning", "--severity", "3", "--relation",
                   "4", "--serious", "--action", "cooled", "--outcome", "gone", "--reported", "--json"});
    ASSERT_EQ(noted.code, 0) << noted.err;
    EXPECT_EQ(jsonOf(noted), Json({{"session", session}, {"adverse_events", 1}}));
    EXPECT_EQ(jsonOf(desk_.run({"study", "show", study(), "--json"})).at("adverse_events"), 1);
    ASSERT_EQ(desk_.run({"report", study(), "--out", at("events.html"), "--for", "committee"}).code, 0);
    const auto text = readTextFile(at("events.html")).value_or("");
    for (const char* said : {"burning", "cooled", "gone"}) EXPECT_THAT(text, HasSubstr(said));
}

TEST_F(StudyExport, WhatStandardsAskIsNotedAndReportedAndUnknownWhereItIsNot) {
    RecordProperty("hazard", "H11");
    const auto noted = desk_.run({"study", "note", study(), "particulars", "--set", "objectives=to find, the range",
                                  "--set", "electrode_shape=ring", "--set", "medication=none", "--json"});
    ASSERT_EQ(noted.code, 0) << noted.err;
    EXPECT_EQ(jsonOf(noted).at("said").at("electrode_shape"), "ring");
    expectRefused(desk_.run({"study", "note", study(), "particulars", "--set", "electrode_shape=star"}), 2,
                  {"electrode_shape is \"star\"", "rectangular"});
    expectRefused(desk_.run({"study", "note", study(), "diary", "--set", "a=b"}), 2, {"one of particulars, assessed"});
    expectRefused(desk_.run({"study", "release", study(), "1", "--by", "KL"}), 3, {"has no adverse event 1"});
    ASSERT_EQ(desk_
                  .run({"study", "adverse-event", study(), "--what", "fell", "--severity", "1", "--relation", "1",
                        "--serious", "--onset", "2026-11-20", "--expected", "unexpected"})
                  .code,
              0);
    ASSERT_EQ(desk_.run({"study", "release", study(), "1", "--by", "K. Lang"}).code, 0);
    const auto shown = jsonOf(desk_.run({"study", "show", study(), "--json"}));
    EXPECT_EQ(shown.at("notes").size(), 1U);
    ASSERT_EQ(desk_.run({"report", study(), "--out", at("c.html"), "--for", "committee"}).code, 0);
    const auto text = readTextFile(at("c.html")).value_or("");
    for (const char* said : {"to find, the range", "unexpected", "released by K. Lang", "unknown"})
        EXPECT_THAT(text, HasSubstr(said));
    ASSERT_EQ(desk_.run({"export", study(), "--format", "bids", "--out", at("bids")}).code, 0);
    EXPECT_THAT(readTextFile(at("bids") + "/README").value_or(""), HasSubstr("Objectives: to find, the range"));
    for (const auto& entry : fs::recursive_directory_iterator(at("bids"))) {
        if (!entry.path().string().ends_with("_beh.json")) continue;
        const auto about = Json::parse(readTextFile(entry.path()).value_or("{}"));
        EXPECT_EQ(about.at("Medication"), "none");
        EXPECT_EQ(about.at("ConcurrentTask"), "unknown") << "as it was left";
    }
    const auto german = readTextFile(sourceDir() / "resources/words/de.json").value_or("{}");
    for (const auto& [key, words] : Json::parse(german).at("words").items())
        EXPECT_THAT(text, HasSubstr(words.get<std::string>())) << key;
}

TEST_F(StudyExport, TheDayAfterIsNotedOnALaterDayAlone) {
    RecordProperty("hazard", "H12");
    const auto session =
        jsonOf(desk_.run({"study", "show", study(), "--json"})).at("sessions").at(0).at("id").get<std::string>();
    const Words today{"study", "next-day", study(), session, "--erythema", "1", "--oedema", "0"};
    expectRefused(desk_.run(today), 4, {"on a later day"});
    auto wrong = today;
    wrong.insert(wrong.end(), {"--side-effect", "redness:2"});
    expectRefused(desk_.run(wrong), 2, {"\"redness:2\" is not a side effect", "redness:2:4"});
    wrong[5] = "7";
    expectRefused(desk_.run(wrong), 2, {"--erythema is \"7\"; a whole number from 0 to 4 is expected"});
    ASSERT_EQ(desk_.run({"report", study(), "--out", at("asked.html")}).code, 0);
    EXPECT_THAT(readTextFile(at("asked.html")).value_or(""), HasSubstr("not asked"));
}

TEST_F(StudyExport, AReportThatNamesPeopleIsNotedBeforeItIsWritten) {
    RecordProperty("hazard", "H11");
    const auto head = [&] {
        return jsonOf(desk_.run({"study", "show", study(), "--json"})).at("ledger_head").get<std::string>();
    };
    const auto atFirst = head();
    ASSERT_EQ(desk_.run({"report", study(), "--out", at("committee.html"), "--for", "committee"}).code, 0);
    EXPECT_EQ(head(), atFirst) << "it names no participant";
    ASSERT_EQ(desk_.run({"report", study(), "--out", at("study.html")}).code, 0);
    const auto noted = head();
    EXPECT_NE(noted, atFirst);
    ASSERT_EQ(desk_.run({"report", study(), "--out", at("study.html"), "--noted"}).code, 0);
    EXPECT_EQ(head(), noted) << "it stands there already";
    expectRefused(desk_.run({"report", study(), "--out", at("other.html"), "--noted"}), 2,
                  {"notes no study report in", "other.html"});
    EXPECT_FALSE(fs::exists(at("other.html"))) << "a claim is not a row";
    expectRefused(desk_.run({"report", study(), "--out", at("nowhere/study.html")}), 3, {"is not a folder"});
    EXPECT_EQ(head(), noted) << "nothing is noted that cannot be written";
    const auto code = run_.at("participant").at("code").get<std::string>();
    ASSERT_EQ(desk_.run({"report", study(), "--out", at("page.html"), "--participant", code}).code, 0);
    EXPECT_NE(head(), noted);
    EXPECT_EQ(desk_.run({"verify", study()}).code, 0);
}

TEST_F(StudyExport, ReportsAreForTheStudyTheCommitteeAndTheParticipant) {
    const auto code = run_.at("participant").at("code").get<std::string>();
    ASSERT_EQ(desk_.run({"report", study(), "--out", at("study.html")}).code, 0);
    const auto text = readTextFile(at("study.html")).value_or("");
    EXPECT_THAT(text, HasSubstr("told the four apart in"));
    EXPECT_THAT(text, HasSubstr(code));
    ASSERT_EQ(desk_.run({"report", study(), "--out", at("committee.html"), "--for", "committee"}).code, 0);
    EXPECT_THAT(readTextFile(at("committee.html")).value_or(""), Not(HasSubstr(code)));
    ASSERT_EQ(desk_.run({"report", study(), "--out", at("page.pdf"), "--participant", code}).code, 0);
    EXPECT_GT(fs::file_size(at("page.pdf")), 2000U);
    expectRefused(desk_.run({"report", study(), "--out", at("other.pdf"), "--participant", "P-ZZZZ"}), 3, {"P-ZZZZ"});
}

TEST(StudyOfTwoEncodings, EachPersonHasBothInAnOrderOfTheirOwnAndSaysWhichTheyPrefer) {
    RecordProperty("hazard", "H9");
    const Desk desk;
    const auto passphrase = desk.write("passphrase", "correct horse 4711\n");
    const auto study = desk.at("study");
    const auto with = [&](Words words) {
        words.insert(words.end(), {"--passphrase-file", passphrase});
        const auto ran = desk.run(words);
        EXPECT_EQ(ran.code, 0) << ran.err;
        return ran;
    };
    with({"study", "create", study, "--title", "Two encodings", "--approval", "EC-17", "--from", "2026-01-01",
          "--expires", "2099-12-31", "--consent-version", "2", "--set", "encodings=standard,swapped", "--set",
          "gap_min_h=0", "--set", "blocks=1"});
    const auto enrolled = with({"study", "enrol", study, "--virtual", "7", "--json"});
    const auto code = jsonOf(enrolled).at("code").get<std::string>();
    with({"study", "consent", study, code, "--version", "2", "--date", "2026-11-20", "--by", "KL"});
    std::vector<std::string> had;
    for (int session = 1; session <= 2; ++session) {
        const auto ran = with({"run", "pilot-identification", "--device", "sim:", "--out", study, "--set",
                               "participant=" + code, "--seed", "3", "--json"});
        had.push_back(jsonOf(ran).at("results").at("encoding"));
    }
    EXPECT_EQ(had, (std::vector<std::string>{"standard", "swapped"}));
    const auto report = desk.at("study.html");
    with({"report", study, "--out", report});
    const auto text = readTextFile(report).value_or("");
    EXPECT_THAT(text, HasSubstr("Easier to tell: no difference. More like touch: no difference."));
    EXPECT_THAT(text, HasSubstr("1 participant(s) had standard, swapped. The orders are not balanced"));
    with({"export", study, "--format", "bids", "--out", desk.at("bids")});
    std::size_t asked = 0;
    for (const auto& entry : fs::recursive_directory_iterator(desk.at("bids"))) {
        if (!entry.path().string().ends_with("task-ratings_beh.tsv")) continue;
        const auto rows = readTextFile(entry.path()).value_or("");
        if (rows.find("more-like-touch\tn/a\tno-difference") == std::string::npos) continue;
        ++asked;
        EXPECT_THAT(entry.path().string(), HasSubstr("ses-02"));
    }
    EXPECT_EQ(asked, 1U) << "after the second encoding alone";
}

/// Each session is a row with its encoding, and the figures are those that the session itself came to.
TEST_F(StudyExport, ResultsAndFiguresAreThoseOfTheSessions) {
    RecordProperty("hazard", "H9");
    const auto ran = desk_.run({"study", "results", study(), "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto part = jsonOf(ran).at("parts").at(0);
    EXPECT_EQ(part.at("basis"), "virtual participant");
    ASSERT_EQ(part.at("sessions").size(), 1U);
    const auto& session = part.at("sessions")[0];
    EXPECT_EQ(session.at("encoding"), "standard");
    EXPECT_EQ(session.at("hits"), run_.at("hits"));
    EXPECT_EQ(session.at("n"), run_.at("n"));
    EXPECT_NEAR(session.at("information").at("value").get<double>(), run_.at("it_corrected_bits").get<double>(), 1e-9);
    EXPECT_EQ(part.at("encodings").at(0).at("hits"), run_.at("hits"));
    EXPECT_TRUE(part.at("differences").empty());
    EXPECT_TRUE(part.at("better").is_null());
    const auto said = desk_.run({"study", "results", study()});
    EXPECT_EQ(said.code, 0) << said.err;
    EXPECT_THAT(said.out, HasSubstr("standard"));

    const auto drawn = desk_.run({"report", study(), "--figures", at("figures")});
    ASSERT_EQ(drawn.code, 0) << drawn.err;
    const auto code = run_.at("participant").at("code").get<std::string>();
    for (const char* name : {"-session-1-function", "-session-1-trace", "-blocks", "-thresholds", "-response-times"}) {
        const auto text = readTextFile(fs::path(at("figures")) / (code + name + ".svg")).value_or("");
        EXPECT_THAT(text, HasSubstr("<svg")) << name;
        EXPECT_THAT(text, HasSubstr("SIMULATED")) << name;
    }
    expectRefused(desk_.run({"report", study(), "--figures", at("figures")}), 3, {"figures", "new or empty folder"});
    expectRefused(desk_.run({"report", study(), "--figures", study() + "/figures"}), 3, {"inside the study folder"});
    expectRefused(desk_.run({"report", study(), "--figures", at("other"), "--for", "committee"}), 2, {"--figures"});
    expectRefused(desk_.run({"report", at("nothing.tacto"), "--figures", at("other")}), 2,
                  {"--figures is for a study"});
}

}  // namespace
}  // namespace tacto::test
