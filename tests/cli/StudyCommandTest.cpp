// study and verify STUDY: the promises of pilot.md section 10, as a user types the commands.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/Csv.h"
#include "tests/cli/RunCli.h"
#include "tests/cli/Shape.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class StudyCli : public testing::Test {
protected:
    void SetUp() override { passphrase = desk.write("passphrase", "correct horse 4711\n"); }
    [[nodiscard]] Ran study(Words words) const {
        words.insert(words.begin(), "study");
        words.insert(words.end(), {"--passphrase-file", passphrase, "--json"});
        return desk.run(words);
    }
    [[nodiscard]] Ran create(const std::string& expires = "2099-12-31", const Words& more = {}) const {
        Words words{"create", desk.at("study"), "--title",   "Four conditions", "--approval",        "EC-17",
                    "--from", "2026-01-01",     "--expires", expires,           "--consent-version", "2"};
        words.insert(words.end(), more.begin(), more.end());
        return study(words);
    }
    [[nodiscard]] std::string at() const { return desk.at("study"); }
    Desk desk;
    std::string passphrase;
};

TEST_F(StudyCli, AGuessAtAPassphraseTakesTheMemoryThatIsPromised) {
    RecordProperty("hazard", "H11");
    constexpr long kPromised_KiB = 256L << 10;
    const auto cheap = create();
    ASSERT_EQ(cheap.code, 0) << cheap.err;
    desk.payForPassphrases();
    const auto dear = study({"show", at()});
    EXPECT_EQ(dear.code, 3) << dear.err;  // sealed at another cost, and so with another key
    EXPECT_GE(dear.most_KiB, kPromised_KiB);
    EXPECT_LT(cheap.most_KiB, kPromised_KiB);  // without a real passphrase, less memory is needed
}

TEST_F(StudyCli, APassphraseIsJudgedAndChangedAndTheEarlierOneOpensNothing) {
    RecordProperty("hazard", "H11");
    const auto strong = std::exchange(passphrase, desk.write("weak", "summer 2026\n"));
    expectRefused(create(), 2, {"bits of guessing; at least 40 bits"});
    passphrase = strong;
    ASSERT_EQ(create().code, 0);
    expectRefused(study({"passphrase", at(), "--new-passphrase-file", desk.at("weak")}), 2, {"at least 40 bits"});
    const auto next = desk.write("next", "kettle river 3094 lamp\n");
    const auto changed = study({"passphrase", at(), "--new-passphrase-file", next});
    ASSERT_EQ(changed.code, 0) << changed.err;
    EXPECT_THAT(changed.err, HasSubstr("replace them"));
    expectRefused(study({"show", at()}), 3, {"the passphrase does not open"});
    passphrase = next;
    EXPECT_EQ(study({"show", at()}).code, 0);
    expectRefused(study({"enrol", at(), "--age", "17"}), 4, {"below the approval's; 18 years or more"});
    const auto code = jsonOf(study({"enrol", at(), "--age", "18"})).at("code").get<std::string>();
    expectRefused(study({"consent", at(), code, "--version", "1", "--date", "2026-02-01", "--by", "KL"}), 2,
                  {"version 2, which is in force, is expected"});
}

TEST_F(StudyCli, GoingBackIsTwoStepsAndStandsInEachReport) {
    RecordProperty("hazard", "H11");
    ASSERT_EQ(create().code, 0);
    const auto code = jsonOf(study({"enrol", at(), "--virtual", "7"}))["code"].get<std::string>();
    const auto old = desk.at("old"), newest = desk.at("newest");
    std::filesystem::copy(at(), old, std::filesystem::copy_options::recursive);
    const Words confirmed{"go-back", at(), "--confirm", "lose-1-rows"};
    const auto none = study(confirmed);
    EXPECT_EQ(none.code, 4);
    EXPECT_THAT(none.err, HasSubstr("there is nothing to go back from"));
    ASSERT_EQ(study({"enrol", at(), "P-7K3D"}).code, 0);
    std::filesystem::rename(at(), newest);
    std::filesystem::rename(old, at());
    for (const auto& words :
         {Words{"enrol", at(), "--virtual", "8"}, Words{"leave", at(), code},
          Words{"withdraw", at(), code, "--confirm", code}, Words{"amend", at(), "--reference", "EC-18"},
          Words{"consent", at(), code, "--version", "2", "--date", "2026-11-20", "--by", "KL"}}) {
        const auto refused = study(words);
        EXPECT_EQ(refused.code, 4) << words.front();
        EXPECT_EQ(refused.out, "");
        EXPECT_THAT(refused.err, HasSubstr("tactoscope-cli study go-back says what that gives up"));
    }
    const auto exported =
        desk.run({"export", at(), "--format", "bids", "--out", desk.at("bids"), "--passphrase-file", passphrase});
    EXPECT_NE(exported.code, 0);
    EXPECT_FALSE(std::filesystem::exists(desk.at("bids")));
    EXPECT_EQ(jsonOf(study({"show", at()}))["participants"].size(), 1U) << "it can be read";
    const auto asked = study({"go-back", at()});
    EXPECT_EQ(asked.code, 2);
    EXPECT_THAT(asked.err, HasSubstr("Lost with it: 1 row (1 enrolled); the enrolment of P-7K3D"));
    EXPECT_THAT(asked.err, HasSubstr("--confirm lose-1-rows goes on with this ledger"));
    EXPECT_EQ(study({"go-back", at(), "--confirm", "lose-2-rows"}).code, 2);
    const auto done = study(confirmed);
    ASSERT_EQ(done.code, 0) << done.err;
    EXPECT_EQ(jsonOf(done)["lost"], 1);
    EXPECT_EQ(study({"enrol", at(), "--virtual", "8"}).code, 0);
    EXPECT_EQ(jsonOf(study({"show", at()}))["went_back"].size(), 1U);
    EXPECT_THAT(desk.run({"verify", at()}).out, HasSubstr("ledger went back on"));
    for (const Words& more : {Words{}, Words{"--for", "committee"}}) {
        const auto page = desk.at("report.html");
        const auto drawn = desk.run(Words{"report", at(), "--out", page, "--passphrase-file", passphrase} + more);
        ASSERT_EQ(drawn.code, 0) << drawn.err;
        EXPECT_THAT(readTextFile(page).value(), HasSubstr("ledger went back on"));
    }
    std::filesystem::rename(at(), old);
    std::filesystem::rename(newest, at());
    EXPECT_EQ(study({"enrol", at(), "--virtual", "9"}).code, 4) << "the one that was given up";
}

TEST_F(StudyCli, APassphraseThatOthersMayReadOpensNothing) {
    RecordProperty("hazard", "H11");
    ASSERT_EQ(create().code, 0);
    std::filesystem::permissions(passphrase, std::filesystem::perms::others_read, std::filesystem::perm_options::add);
    const auto shown = study({"show", at()});
    EXPECT_EQ(shown.code, 3);
    EXPECT_EQ(shown.out, "");
    EXPECT_THAT(shown.err, HasSubstr("(mode 0604); mode 0600 is expected: chmod 600 " + passphrase));
}

TEST_F(StudyCli, IsMadeEnrolledInConsentedToShownLeftAndWithdrawnFrom) {
    RecordProperty("hazard", "H11");
    const auto made = create("2099-12-31", {"--set", "blocks=3"});
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_THAT(made.err, HasSubstr("Without the passphrase or without this file the data are lost"));
    const auto enrolled = study({"enrol", at(), "--virtual", "7"});
    ASSERT_EQ(enrolled.code, 0) << enrolled.err;
    const auto code = jsonOf(enrolled)["code"].get<std::string>();
    ASSERT_EQ(study({"enrol", at(), "P-7K3D"}).code, 0);
    ASSERT_EQ(study({"consent", at(), code, "--version", "2", "--date", "2026-11-20", "--by", "KL"}).code, 0);
    auto shown = jsonOf(study({"show", at()}));
    EXPECT_EQ(shown["title"], "Four conditions");
    EXPECT_EQ(shown["rehearsal"], false);
    EXPECT_EQ(shown["approval"],
              Json({{"reference", "EC-17"}, {"from", "2026-01-01"}, {"expires", "2099-12-31"}, {"valid", true}}));
    EXPECT_EQ(shown["consent_version"], "2");
    EXPECT_EQ(
        shown["participants"],
        Json::array(
            {{{"code", code}, {"virtual", 7}, {"state", "active"}, {"consent", "2"}, {"sessions", 0}},
             {{"code", "P-7K3D"}, {"virtual", nullptr}, {"state", "active"}, {"consent", nullptr}, {"sessions", 0}}}));
    EXPECT_EQ(shown["withdrawn"], 0);
    EXPECT_EQ(shown["sessions"], Json::array());
    EXPECT_EQ(shown["amendments"], Json::array());
    EXPECT_EQ(shown["adverse_events"], 0);
    EXPECT_EQ(shown["ledger_head"].get<std::string>().size(), 64U);

    const auto sealed = desk.run({"study", "show", at(), "--json"});
    ASSERT_EQ(sealed.code, 0) << sealed.err;
    EXPECT_THAT(sealed.out, testing::Not(HasSubstr(code)));
    EXPECT_EQ(jsonOf(sealed)["participants"].size(), 2U);

    EXPECT_EQ(study({"withdraw", at(), code, "--confirm", "P-7K3D"}).code, 2);
    ASSERT_EQ(
        desk.run({"export", at(), "--format", "bids", "--out", desk.at("bids"), "--passphrase-file", passphrase}).code,
        0);
    const auto withdrawn = study({"withdraw", at(), code, "--confirm", code});
    ASSERT_EQ(withdrawn.code, 0) << withdrawn.err;
    EXPECT_THAT(withdrawn.err, HasSubstr("Delete them by hand:\n  " + desk.at("bids")));
    ASSERT_EQ(study({"leave", at(), "P-7K3D"}).code, 0);
    EXPECT_EQ(study({"leave", at(), "P-7K3D"}).code, 4);
    EXPECT_EQ(study({"leave", at(), code}).code, 3);
    shown = jsonOf(study({"show", at()}));
    EXPECT_EQ(shown["withdrawn"], 1);
    EXPECT_EQ(shown["participants"].size(), 1U);
    EXPECT_EQ(shown["participants"][0]["state"], "left");

    const auto verified = desk.run({"verify", at(), "--json"});
    EXPECT_EQ(verified.code, 0) << verified.out;
    EXPECT_EQ(jsonOf(verified)["status"], "intact");
    EXPECT_EQ(jsonOf(verified)["ledger"]["head"], shown["ledger_head"]);
}

TEST_F(StudyCli, IsNotMadeWhereEverySessionWouldRefuseItsTrain) {
    RecordProperty("hazard", "H11");
    const std::string pulses = "train.pulses=50", rate = "train.rate_hz=50";
    const auto tooLong = create("2099-12-31", {"--set", pulses, "--set", rate});
    EXPECT_EQ(tooLong.code, 2);
    EXPECT_THAT(tooLong.err, HasSubstr("lasts 1 s, which is not below interval_min_s 0.5 s"));
    const auto crowded = create("2099-12-31", {"--set", "train.width_us=1000", "--set", "train.rate_hz=1000"});
    EXPECT_EQ(crowded.code, 2);
    EXPECT_THAT(crowded.err, HasSubstr("does not fit into its period"));
    EXPECT_FALSE(std::filesystem::exists(at()));
    EXPECT_EQ(create("2099-12-31", {"--set", "train.pulses=20", "--set", rate}).code, 0);
}

TEST_F(StudyCli, AnAmendmentRenewsTheApprovalAndIsListed) {
    RecordProperty("hazard", "H11");
    ASSERT_EQ(create("2026-02-01", {"--set", "license=CC-BY-4.0"}).code, 0);
    const auto amended =
        study({"amend", at(), "--reference", "EC-17 A1", "--expires", "2099-12-31", "--set", "blocks=4"});
    ASSERT_EQ(amended.code, 0) << amended.err;
    const auto made = jsonOf(amended);
    EXPECT_EQ(made["reference"], "EC-17 A1");
    EXPECT_EQ(made["changed"], Json({"approval.expires", "blocks"}));
    EXPECT_EQ(made["date"].get<std::string>().size(), 10U);
    const auto sealed = desk.run({"study", "show", at(), "--json"});
    const auto shown = jsonOf(sealed);
    EXPECT_EQ(shown["amendments"], Json::array({made}));
    EXPECT_EQ(shown["approval"],
              Json({{"reference", "EC-17 A1"}, {"from", "2026-01-01"}, {"expires", "2099-12-31"}, {"valid", true}}));
    EXPECT_THAT(desk.run({"study", "show", at()}).out, HasSubstr("changed approval.expires, blocks"));
    // The license belongs to the study but not to the protocol, so it needs no amendment.
    ASSERT_EQ(
        desk.run({"export", at(), "--format", "bids", "--out", desk.at("bids"), "--passphrase-file", passphrase}).code,
        0);
    EXPECT_THAT(contentOf(desk.at("bids/dataset_description.json")), HasSubstr("\"License\": \"CC-BY-4.0\""));
}

TEST_F(StudyCli, BadInputIsOneSentenceAndChangesNothing) {
    RecordProperty("hazard", "H12");
    ASSERT_EQ(create("2026-02-01").code, 0);
    EXPECT_EQ(jsonOf(desk.run({"study", "show", at(), "--json"}))["approval"]["valid"], false);
    const auto before = desk.files("study");
    const auto expect = [&](const Ran& ran, int code, const char* part) {
        EXPECT_EQ(ran.code, code) << ran.err;
        EXPECT_THAT(ran.err, HasSubstr(part));
        EXPECT_EQ(std::ranges::count(ran.err, '\n'), 1) << ran.err;
        EXPECT_EQ(desk.files("study"), before);
    };
    expect(create(), 3, "holds a study");
    expect(study({"leave", at(), "P-7K3M"}), 3, "its check character is wrong");
    expect(study({"leave", at(), "P-7K3D"}), 3, "has no participant");
    expect(desk.run({"study", "leave", at(), "P-7K3D"}), 3, "passphrase is needed");
    expect(desk.run({"study", "enrol", at(), "--passphrase-file", desk.write("other", "wrong")}), 3,
           "the passphrase does not open");
    expect(desk.run({"study", "enrol", at(), "--passphrase-file", desk.write("study-no", "")}), 3, "holds nothing");
    expect(study({"show", desk.at("nowhere")}), 3, "there is no study");
    expect(study({"consent", at(), "P-7K3D", "--version", "2", "--date", "20.11.2026", "--by", "KL"}), 2, "--date");
    expect(study({"enrol", at(), "--virtual", "-1"}), 2, "virtual");
    expect(study({"dance", at()}), 2, "there is no \"dance\"");
    expect(study({"leave", at()}), 2, "STUDY and CODE");
    expect(study({"amend", at(), "--set", "blocks=4"}), 2, "--reference is missing");
    expect(study({"amend", at(), "--reference", "EC-17"}), 2,
           "an amendment needs a reference of its own, not \"EC-17\"");
    expect(study({"amend", at(), "--reference", "A1", "--set", "cap_ma=16"}), 2, "\"cap_ma\" is 16");
    expect(study({"adverse-event", at()}), 2, "--what is missing");
    expect(study({"next-day", at()}), 2, "STUDY and SESSION");
    expect(study({"adverse-event", at(), "00", "--what", "pain", "--severity", "5", "--relation", "1"}), 2,
           "--severity is \"5\"; a whole number from 1 to 4 is expected");
    expect(study({"adverse-event", at(), "00", "--what", "pain", "--severity", "2", "--relation", "3"}), 3,
           "the study has no session 00");
    expect(study({"leave", at(), "P-7K3D", "--virtual", "3"}), 2, "takes no --virtual");
    Words other{"create", desk.at("second"), "--title",   "T",          "--approval",        "A",
                "--from", "2026-02-01",      "--expires", "2026-01-01", "--consent-version", "1"};
    expect(study(other), 2, "begins on");
    other[9] = "2099-01-01";
    other.insert(other.end(), {"--set", "site=chest"});
    expect(study(other), 2, "\"site\" is \"chest\"");
    EXPECT_FALSE(std::filesystem::exists(desk.at("second")));
}

TEST_F(StudyCli, ADamagedOneIsFoundWithoutThePassphrase) {
    RecordProperty("hazard", "H8");
    ASSERT_EQ(create().code, 0);
    ASSERT_EQ(study({"enrol", at()}).code, 0);
    auto ledger = contentOf(desk.at("study/ledger.tacto"));
    const auto place = ledger.find("\"sealed\":\"");
    ASSERT_LT(place, ledger.size());
    ledger[place + 50] = static_cast<char>(ledger[place + 50] ^ 1);
    desk.write("study/ledger.tacto", ledger);
    const auto verified = desk.run({"verify", at(), "--json"});
    EXPECT_EQ(verified.code, 1);
    EXPECT_EQ(jsonOf(verified)["status"], "damaged");
    const auto enrolled = study({"enrol", at()});
    EXPECT_EQ(enrolled.code, 3);
    EXPECT_THAT(enrolled.err, HasSubstr("the ledger of the study in"));
}

TEST_F(StudyCli, AProfileThatWasNotApprovedBeginsNoSessionUntilItIsAmended) {
    RecordProperty("hazard", "H11");
    const auto other = desk.write("other.json", R"({"encoding": {"interval_max_s": 3}})");
    ASSERT_EQ(create("2099-12-31", {"--set", "procedure.method=staircase"}).code, 0);
    const auto code = jsonOf(study({"enrol", at(), "--virtual", "7"}))["code"].get<std::string>();
    ASSERT_EQ(study({"consent", at(), code, "--version", "2", "--date", "2026-11-20", "--by", "KL"}).code, 0);
    const auto run = [&](const Words& more) {
        Words words{"run",   "pilot-thresholds",    "--device",          "sim:",     "--out", at(),
                    "--set", "participant=" + code, "--passphrase-file", passphrase, "--json"};
        words.insert(words.end(), more.begin(), more.end());
        return desk.run(words);
    };
    expectRefused(run({"--profile", other}), 4, {"longest interval is 3 s, and approval EC-17 is for 2 s"});
    expectRefused(run({"--set", "method=quest"}), 4, {"quest, and approval EC-17 is for staircase"});
    EXPECT_EQ(jsonOf(study({"show", at()}))["sessions"], Json::array());
    expectRefused(study({"amend", at(), "--reference", "EC-18", "--profile", desk.at("none.json")}), 2, {"none.json"});
    const auto amended = study({"amend", at(), "--reference", "EC-18", "--profile", other});
    ASSERT_EQ(amended.code, 0) << amended.err;
    EXPECT_EQ(jsonOf(amended)["changed"], Json::array({"procedure.interval_max_s"}));
    const auto shown = jsonOf(study({"show", at()}))["procedure"];
    EXPECT_EQ(shown["interval_max_s"], 3);
    EXPECT_EQ(shown["method"], "staircase");
    const auto words = desk.run({"study", "show", at()}).out;
    EXPECT_THAT(words, HasSubstr("Train: biphasic, 1 pulse of 200 µs a phase, 50 µs between the phases"));
    EXPECT_THAT(words, HasSubstr("Intervals: 0.5 to 3 s from onset to onset"));
    EXPECT_THAT(words, HasSubstr("Detection: weighted staircase"));
    EXPECT_THAT(words, HasSubstr("Weber fraction of strength: not measured"));
    EXPECT_THAT(words, HasSubstr("changed longest interval"));
    expectRefused(run({}), 4, {"longest interval is 2 s, and approval EC-18 is for 3 s"});
    const auto ran = run({"--profile", other});
    EXPECT_THAT(ran.code, testing::AnyOf(0, 5)) << ran.err;
    EXPECT_EQ(jsonOf(ran).at("results").at("detection").at("method"), "staircase") << "asked as approved";
}

TEST_F(StudyCli, TheBetterEncodingIsTakenAloneByAnAmendmentAndByNoProfileWithoutOne) {
    RecordProperty("hazard", "H11");
    ASSERT_EQ(create("2099-12-31", {"--set", "encodings=standard,swapped", "--set", "exclusions=A tattoo?"}).code, 0);
    const auto code = jsonOf(study({"enrol", at(), "--virtual", "7"}))["code"].get<std::string>();
    ASSERT_EQ(study({"consent", at(), code, "--version", "2", "--date", "2026-11-20", "--by", "KL"}).code, 0);
    const auto run = [&](const Words& more) {
        return desk.run(Words{"run", "pilot-thresholds", "--device", "sim:", "--out", at(), "--set",
                              "participant=" + code, "--passphrase-file", passphrase, "--json"} +
                        more);
    };
    // A virtual participant can say yes to the study's own questions too.
    expectRefused(run({"--set", "exclusions=own-1"}), 4, {"an answer to the exclusion checklist is yes"});
    expectRefused(run({"--set", "exclusions=own-2"}), 2, {"exclusions is \"own-2\"", "hf, own-1"});
    const auto swapped = desk.write("swapped.json", R"({"encoding": {"assignment": "swapped"}})");
    expectRefused(run({"--profile", swapped}), 4, {"assignment", "EC-17"});
    expectRefused(study({"amend", at(), "--reference", "EC-18", "--profile", swapped}), 2,
                  {"encodings are standard and swapped", "swapped already", "one of them is accepted"});
    EXPECT_EQ(jsonOf(study({"show", at()}))["sessions"], Json::array());
    const auto amended = study({"amend", at(), "--reference", "EC-18", "--set", "encodings=swapped"});
    ASSERT_EQ(amended.code, 0) << amended.err;
    EXPECT_EQ(jsonOf(amended)["changed"], Json::array({"encodings"}));
    const auto ran = run({});
    EXPECT_THAT(ran.code, testing::AnyOf(0, 5)) << ran.err;
    const auto other = jsonOf(study({"amend", at(), "--reference", "EC-19", "--profile", swapped}));
    EXPECT_EQ(other["changed"], Json::array({"procedure.conditions_sha256"})) << "another study takes it as a profile";
}

TEST_F(StudyCli, StrengthsAreComparedWhereTheApprovalIsForIt) {
    RecordProperty("hazard", "H11");
    ASSERT_EQ(create("2099-12-31", {"--set", "procedure.comparison=yes"}).code, 0);
    const auto code = jsonOf(study({"enrol", at(), "--virtual", "8"}))["code"].get<std::string>();
    ASSERT_EQ(study({"consent", at(), code, "--version", "2", "--date", "2026-11-20", "--by", "KL"}).code, 0);
    const auto run = [&](const Words& more) {
        return desk.run(Words{"run", "pilot-thresholds", "--device", "sim:", "--out", at(), "--set",
                              "participant=" + code, "--passphrase-file", passphrase, "--json"} +
                        more);
    };
    expectRefused(run({"--set", "comparison=no"}), 4, {"strength is not measured, and approval EC-17 is for measured"});
    EXPECT_EQ(jsonOf(study({"show", at()}))["sessions"], Json::array());
    const auto ran = run({});
    EXPECT_THAT(ran.code, testing::AnyOf(0, 5)) << ran.err;
    EXPECT_EQ(jsonOf(ran).at("results").at("comparison").is_null(), ran.code == 5) << "as approved, without a word";
}

TEST_F(StudyCli, TheGroupOfAParticipantIsEnrolledAndWhoHadNoSessionIsNotExported) {
    ASSERT_EQ(create().code, 0);
    EXPECT_EQ(study({"enrol", at(), "--group", "amputee"}).code, 2);
    EXPECT_EQ(jsonOf(study({"show", at()}))["participants"], Json::array());
    ASSERT_EQ(study({"enrol", at(), "--group", "limb difference"}).code, 0);
    ASSERT_EQ(study({"enrol", at()}).code, 0);
    ASSERT_EQ(
        desk.run({"export", at(), "--format", "bids", "--out", desk.at("bids"), "--passphrase-file", passphrase}).code,
        0);
    const auto people = readTextFile(desk.at("bids") + "/participants.tsv").value_or("");
    EXPECT_EQ(std::ranges::count(people, '\n'), 1) << people;
    EXPECT_THAT(readTextFile(desk.at("bids") + "/README").value_or(""), HasSubstr("2 more are enrolled"));
}

}  // namespace
}  // namespace tacto::test
