// A rehearsal from plan to confusion matrix, and how a session is refused, interrupted and continued.
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/Csv.h"
#include "core/session/Digest.h"
#include "core/study/Study.h"
#include "tests/cli/PilotDesk.h"

namespace tacto::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST(Pilot, ARehearsalGoesFromPlanToConfusionMatrix) {
    const PilotDesk desk;
    const auto ran = desk.run("pilot-identification", {"--set", "participant=virtual:7", "--seed", "1"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("rehearsal was made"));
    const auto value = jsonOf(ran);
    EXPECT_TRUE(value["verdict"].is_null());
    EXPECT_TRUE(value["simulated"].get<bool>());
    const auto& results = value["results"];
    EXPECT_TRUE(results["participant"]["virtual"].get<bool>());
    EXPECT_EQ(results["columns"].size(), 6U);
    ASSERT_EQ(results["confusion"].size(), 4U);
    EXPECT_EQ(results["n"], 80);
    EXPECT_EQ(results["catch"]["n"], 10);
    EXPECT_EQ(results["blocks"].size(), 5U);
    EXPECT_FALSE(results["resumed"].get<bool>());

    int hits = 0, n = 0;
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 6; ++column) {
            const auto count = results["confusion"][row][column].get<int>();
            n += count;
            if (row == column) hits += count;
        }
    }
    EXPECT_EQ(n, 80);
    EXPECT_EQ(hits, results["hits"]);
    EXPECT_GT(hits, 40) << "of a virtual participant with a usable range";

    // The trials are exactly those of the plan, each answered once.
    std::map<int, json> planned;
    for (const auto& each : results["plan"]) planned[each["number"]] = each;
    std::set<int> answered;
    for (const auto& each : results["trials"]) {
        const int number = each["number"];
        EXPECT_TRUE(answered.insert(number).second) << number;
        ASSERT_TRUE(planned.contains(number));
        EXPECT_EQ(planned[number]["condition"], each["condition"]);
        EXPECT_EQ(planned[number]["phase"], each["phase"]);
    }
    for (const auto& row : results["predicted"]) {
        double sum = 0;
        for (const auto& p : row) sum += p.get<double>();
        EXPECT_NEAR(sum, 1, 1e-6);
    }
    EXPECT_GT(results["fit"]["p"].get<double>(), 1e-4);
    EXPECT_GT(results["truth"]["too_strong_ma"].get<double>(), results["truth"]["detection_ma"].get<double>());
    EXPECT_LT(results["range"]["max_ma"].get<double>(), results["truth"]["too_strong_ma"].get<double>());
    EXPECT_EQ(desk.desk().run({"verify", desk.desk().at("study")}).code, 0);
    EXPECT_TRUE(desk.desk().named("study", ".pdf").empty()) << "no report is written into a study";
}

TEST(Pilot, ThresholdsComeNearTheTruth) {
    const PilotDesk desk;
    const auto ran = desk.run("pilot-thresholds", {"--set", "participant=virtual:7"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto results = jsonOf(ran)["results"];
    const double truth = results["truth"]["detection_ma"];
    EXPECT_NEAR(results["detection"]["estimate_ma"]["value"].get<double>(), truth, 0.35 * truth);
    EXPECT_EQ(results["series"].size(), 3U);
    EXPECT_GE(results["detection"]["trials"].get<int>(), 24);
    EXPECT_EQ(results["detection"]["history"].size(), results["detection"]["trials"].get<std::size_t>());
    EXPECT_TRUE(results["range"]["usable"].get<bool>());
    EXPECT_NEAR(results["range"]["max_v"].get<double>(),
                results["range"]["max_ma"].get<double>() * results["range"]["impedance_ohm"].get<double>() / 1000,
                1e-6);
}

TEST(Pilot, ComparesStrengthsWithinTheRangeWhereItIsAskedTo) {
    RecordProperty("hazard", "H6");
    for (const auto& [unit, devices] :
         {std::pair<std::string, Words>("ma", {"sim:"}), {"intensity", {"sim:massager"}}}) {
        const PilotDesk desk(devices);
        const auto ran = desk.run("pilot-thresholds", {"--set", "participant=virtual:8", "--set", "comparison=yes"});
        ASSERT_EQ(ran.code, 0) << ran.err;
        const auto results = jsonOf(ran)["results"];
        const auto& compared = results["comparison"];
        EXPECT_EQ(compared["trials"], 40);
        ASSERT_EQ(compared["history"].size(), 40U);
        for (const auto& trial : compared["history"]) {
            EXPECT_GE(trial["weaker_" + unit], results["range"]["min_" + unit]);
            EXPECT_LE(trial["stronger_" + unit], results["range"]["max_" + unit]);
        }
        const double truth = results["truth"]["amplitude_weber"];
        EXPECT_LT(compared["amplitude_weber"]["low"].get<double>(), truth);
        EXPECT_GT(compared["amplitude_weber"]["high"].get<double>(), truth);
        const PilotDesk other(devices);
        const auto without = jsonOf(other.run("pilot-thresholds", {"--set", "participant=virtual:8"}))["results"];
        EXPECT_TRUE(without["comparison"].is_null());
        EXPECT_EQ(without["range"], results["range"]) << "what came before is the same";
    }
}

TEST(Pilot, AWholeSessionComparesStrengthsWhereItIsAskedTo) {
    RecordProperty("hazard", "H6");
    const Words one{"--set", "participant=virtual:8", "--set", "blocks=1"};
    auto compares = one;
    compares.insert(compares.end(), {"--set", "comparison=yes"});
    const PilotDesk desk, other;
    const auto ran = desk.run("pilot-identification", compares);
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto with = jsonOf(ran)["results"], without = jsonOf(other.run("pilot-identification", one))["results"];
    EXPECT_EQ(with["thresholds"]["comparison"]["trials"], 40);
    const double truth = with["truth"]["amplitude_weber"];
    EXPECT_LT(with["thresholds"]["comparison"]["amplitude_weber"]["low"].get<double>(), truth);
    EXPECT_GT(with["thresholds"]["comparison"]["amplitude_weber"]["high"].get<double>(), truth);
    EXPECT_TRUE(without["thresholds"]["comparison"].is_null());
    EXPECT_EQ(with["plan"], without["plan"]) << "the order of the test is the same";
}

/// Returns those keys that are missing in `object`.
std::string missingIn(const json& object, std::initializer_list<const char*> keys) {
    std::string missing;
    for (const char* key : keys)
        if (!object.contains(key)) missing += std::string(key) + " ";
    return missing;
}

TEST(Pilot, ItsJsonHasTheKeysOfTheContract) {
    const PilotDesk desk;
    const Words compares{"--set", "participant=virtual:8", "--set", "comparison=yes"};
    const auto thresholds = jsonOf(desk.run("pilot-thresholds", compares, "a"));
    EXPECT_TRUE(thresholds["verdict"].is_null());
    const auto& found = thresholds["results"];
    EXPECT_EQ(missingIn(found, {"participant", "modality", "felt_ma", "too_strong_ma", "series", "detection", "range",
                                "comparison", "truth"}),
              "");
    EXPECT_EQ(missingIn(found["participant"], {"code", "virtual"}), "");
    EXPECT_EQ(missingIn(found["series"][0], {"felt_ma", "too_strong_ma", "highest_ma", "ended_by"}), "");
    EXPECT_EQ(missingIn(found["detection"], {"method", "estimate_ma", "trials", "history"}), "");
    EXPECT_EQ(missingIn(found["detection"]["estimate_ma"], {"value", "low", "high"}), "");
    EXPECT_EQ(missingIn(found["detection"]["history"][0], {"current_ma", "correct"}), "");
    EXPECT_EQ(missingIn(found["range"], {"usable", "reason", "min_ma", "max_ma", "min_v", "max_v", "jnd",
                                         "impedance_ohm", "limited_by"}),
              "");
    EXPECT_EQ(missingIn(found["comparison"], {"amplitude_weber", "at_edge", "trials", "history"}), "");
    EXPECT_EQ(missingIn(found["comparison"]["history"][0], {"weaker_ma", "stronger_ma", "correct"}), "");
    const auto session = jsonOf(desk.run("pilot-identification", shortSession(), "b"));
    EXPECT_TRUE(session["verdict"].is_null());
    const auto& results = session["results"];
    EXPECT_EQ(
        missingIn(results,
                  {"participant", "parts",    "resumed",  "range",     "labels",  "columns",      "confusion",
                   "n",           "hits",     "accuracy", "p_chance",  "it_bits", "it_bias_bits", "it_corrected_bits",
                   "texture",     "pressure", "catch",    "no_answer", "blocks",  "drift",        "presented",
                   "predicted",   "fit",      "truth",    "plan",      "trials"}),
        "");
    for (const char* feature : {"texture", "pressure"})
        EXPECT_EQ(missingIn(results[feature], {"n", "hits", "accuracy", "p_chance", "it_corrected_bits",
                                               "it_corrected_low_bits", "it_corrected_high_bits"}),
                  "");
    EXPECT_EQ(missingIn(results["catch"], {"n", "false_alarms", "rate"}), "");
    EXPECT_EQ(missingIn(results["blocks"][0], {"block", "n", "hits"}), "");
    EXPECT_EQ(missingIn(results["presented"][0], {"name", "current_ma", "interval_s"}), "");
    EXPECT_EQ(missingIn(results["fit"], {"g", "p"}), "");
    EXPECT_EQ(missingIn(results["truth"],
                        {"detection_ma", "too_strong_ma", "amplitude_weber", "interval_weber", "lapse", "noise_jnd"}),
              "");
    EXPECT_EQ(missingIn(results["plan"][0], {"number", "phase", "block", "condition"}), "");
    EXPECT_EQ(missingIn(results["trials"][0], {"number", "phase", "block", "condition", "response", "attempt", "rt_s"}),
              "");
    const auto shown = jsonOf(desk.desk().run({"study", "show", desk.desk().at("b"), "--json"}));
    EXPECT_EQ(
        missingIn(shown, {"title", "rehearsal", "modality", "approval", "procedure", "amendments", "consent_version",
                          "participants", "withdrawn", "sessions", "adverse_events", "ledger_head"}),
        "");
    EXPECT_EQ(missingIn(shown["sessions"][0], {"id", "code", "number", "protocol", "state", "answered"}), "");
}

TEST(Pilot, BreaksLastAMinuteAndTheThirdFive) {
    const PilotDesk desk;
    const auto ran = desk.run("pilot-identification", {"--set", "participant=virtual:7", "--set", "blocks=5"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto study = Study::open(desk.desk().at("study"), nullptr, Study::Access::Read);
    ASSERT_TRUE(study) << study.error().message;
    const auto rows = study->events(study->sessions().front());
    ASSERT_TRUE(rows) << rows.error().message;
    std::vector<double> least_s;
    Instant begun{0};
    for (const auto& each : *rows) {
        if (each.name == "break-begin") {
            least_s.push_back(each.body["least_s"]);
            begun = each.at;
        }
        if (each.name == "break-end") {
            EXPECT_GE(toSeconds(each.at - begun), least_s.back());
        }
    }
    EXPECT_THAT(least_s, testing::ElementsAre(60, 60, 300, 60)) << "and no rest of the drift check";
}

TEST(Pilot, TheSameSeedGivesTheSameAnswersAndAnotherOtherOnes) {
    const PilotDesk desk;
    const auto answers = [&](const char* study, const char* seed) {
        return planAndAnswers(jsonOf(desk.run("pilot-identification", shortSession() + Words{"--seed", seed}, study)));
    };
    const auto first = answers("a", "3");
    EXPECT_EQ(first, answers("b", "3"));
    EXPECT_NE(first, answers("c", "4"));
}

TEST(Pilot, NoUsableRangeIsAResultAndExitsFive) {
    const PilotDesk desk;
    const auto ran =
        desk.run("pilot-identification", {"--set", "participant=virtual:7", "--set", "detection=3", "--set",
                                          "attention=3.1", "--set", "discomfort=3.3", "--set", "intolerance=3.5"});
    EXPECT_EQ(ran.code, 5) << ran.err;
    const auto results = jsonOf(ran)["results"];
    EXPECT_FALSE(results["range"]["usable"].get<bool>());
    EXPECT_TRUE(results["range"]["reason"].is_string());
    EXPECT_EQ(results["n"], 0);
}

struct RefusedPilot {
    const char* name;
    Words words;
    int code;
    const char* says;
};

class PilotRefusal : public testing::TestWithParam<RefusedPilot> {};

TEST_P(PilotRefusal, InASentenceWithNothingMade) {
    RecordProperty("hazard", "H11");
    const PilotDesk desk;
    const auto ran = desk.run("pilot-identification", GetParam().words);
    EXPECT_EQ(ran.code, GetParam().code) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr(GetParam().says));
    EXPECT_FALSE(std::filesystem::exists(desk.desk().at("study")));
}

INSTANTIATE_TEST_SUITE_P(
    Of, PilotRefusal,
    testing::Values(RefusedPilot{"ACodeWithoutAStudy", {"--set", "participant=P-7K3M"}, 3, "no study"},
                    RefusedPilot{"ASeedThatIsNoNumber", {"--set", "participant=virtual:seven"}, 3, "whole number"},
                    RefusedPilot{"NoParticipant", {}, 3, "participant="},
                    RefusedPilot{"AnExclusion",
                                 {"--set", "participant=virtual:7", "--set", "exclusions=epilepsy"},
                                 4,
                                 "exclusion checklist"},
                    RefusedPilot{"AnUnknownExclusion",
                                 {"--set", "participant=virtual:7", "--set", "exclusions=luck"},
                                 2,
                                 "one of"}),
    [](const auto& tested) { return tested.param.name; });

TEST(Pilot, ItsResultsAreReadInTheTerminalWithoutJson) {
    const PilotDesk desk;
    const auto& at = desk.desk();
    const auto run = [&](const char* protocol, const std::string& study, const Words& more) {
        return at.run(Words{"run", protocol, "--out", at.at(study), "--set", "participant=virtual:7"} + more);
    };
    const auto told = run("pilot-identification", "study", {"--device", "sim:", "--set", "blocks=1"});
    ASSERT_EQ(told.code, 0) << told.err;
    EXPECT_THAT(told.out, HasSubstr("(virtual)"));
    EXPECT_THAT(told.out, testing::ContainsRegex("Range, from \\(mA\\) +[0-9.]+\n  to \\(mA\\) +[0-9.]+"));
    EXPECT_THAT(told.out, HasSubstr("Given, and answered"));
    EXPECT_THAT(told.out, testing::ContainsRegex("all +1[0-6]  16"));
    EXPECT_EQ(told.out.find_first_of("{}"), std::string::npos) << told.out;
    const auto vibrated = run("pilot-identification", "massager",
                              {"--device", "sim:massager", "--device", "sim:finger?on=motor", "--set", "blocks=1"});
    ASSERT_EQ(vibrated.code, 0) << vibrated.err;
    EXPECT_EQ(vibrated.out.find("mA"), std::string::npos) << vibrated.out;
    EXPECT_THAT(vibrated.out, testing::ContainsRegex("smooth, firm +[0-9.]+ +0.500"));
    const auto limits = run("pilot-thresholds", "thresholds", {"--device", "sim:"});
    ASSERT_EQ(limits.code, 0) << limits.err;
    EXPECT_THAT(limits.out, testing::ContainsRegex("Detection \\(mA\\) +[0-9.]+"));
    EXPECT_EQ(limits.out.find_first_of("{}"), std::string::npos) << limits.out;
}

TEST(Pilot, AnUnfinishedSessionAsksWhatToDoWithItAndCanBeEnded) {
    const PilotDesk desk;
    ASSERT_EQ(desk.runKilled(120, "pilot-identification", shortSession()), -9);
    const auto asked = desk.run("pilot-identification", shortSession());
    EXPECT_EQ(asked.code, 3) << asked.err;
    EXPECT_THAT(asked.err, HasSubstr("unfinished=resume"));
    const auto other = desk.run("pilot-thresholds", shortSession() + Words{"--set", "unfinished=resume"});
    EXPECT_EQ(other.code, 3) << other.err;
    EXPECT_THAT(other.err, HasSubstr("pilot-identification"));
    const auto ended = desk.run("pilot-identification", shortSession() + Words{"--set", "unfinished=end"});
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(jsonOf(ended)["results"]["parts"], 1);
    const auto shown = jsonOf(desk.desk().run({"study", "show", desk.desk().at("study"), "--json"}));
    ASSERT_EQ(shown["sessions"].size(), 2U);
    EXPECT_EQ(shown["sessions"][0]["state"], "stopped");
    EXPECT_EQ(shown["sessions"][1]["state"], "complete");
}

TEST(Pilot, ASessionThatIsCompleteEndsAsCompleteThoughTheStudyDidNotKnow) {
    RecordProperty("hazard", "H8");
    const PilotDesk desk;
    const Words words{"--set", "participant=virtual:7"};
    const auto isKilled = [&](long sync, const std::string& study) {
        return desk.runKilled(sync, "pilot-thresholds", words, study) == -9;
    };
    long killed = 100, whole = 4000;  // the number of the last row is between these
    while (whole - killed > 1) {
        const long middle = (killed + whole) / 2;
        (isKilled(middle, "at " + std::to_string(middle)) ? killed : whole) = middle;
    }
    const auto statesIn = [&](const std::string& study) {
        const auto shown = jsonOf(desk.desk().run({"study", "show", desk.desk().at(study), "--json"}));
        std::string all;
        for (const auto& each : shown["sessions"]) all += each["state"].get<std::string>() + ' ';
        return all;
    };
    bool found = false;
    for (long sync = killed; !found && sync > killed - 10; --sync) {
        const auto study = "complete " + std::to_string(sync);
        ASSERT_TRUE(isKilled(sync, study));
        if (desk.run("pilot-thresholds", words, study).code != 3) continue;  // the ledger already recorded the end
        const auto other = desk.run("pilot-thresholds", words + Words{"--set", "unfinished=end"}, study);
        ASSERT_EQ(other.code, 0) << other.err;
        found = other.err.find("was ended as complete") != std::string::npos;
        EXPECT_EQ(statesIn(study), found ? "complete complete " : "stopped complete ");
        EXPECT_EQ(desk.desk().run({"verify", desk.desk().at(study)}).code, 0);
    }
    EXPECT_TRUE(found) << "no row between the session's end and the ledger's in the last ten";
}

TEST(Pilot, AFullDiskEndsTheSessionWithoutOutputAndItGoesOnOnceThereIsRoom) {
    RecordProperty("hazard", "H8");
    const PilotDesk desk;
    const auto whole = desk.run("pilot-identification", shortSession(), "whole");
    ASSERT_EQ(whole.code, 0) << whole.err;
    const auto full = desk.runDisturbed({.largestFile = 250'000}, "pilot-identification", shortSession());
    EXPECT_EQ(full.code, 3) << full.err;
    const auto says = full.err.find("cannot be written");
    EXPECT_NE(says, std::string::npos);
    EXPECT_EQ(full.err.find("cannot be written", says + 1), std::string::npos) << "once: " << full.err;
    const auto ran = desk.run("pilot-identification", shortSession() + Words{"--set", "unfinished=resume"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto value = jsonOf(ran);
    EXPECT_TRUE(value["results"]["resumed"].get<bool>());
    EXPECT_EQ(value["results"]["parts"], 2);
    EXPECT_EQ(planAndAnswers(value), planAndAnswers(jsonOf(whole)));
}

TEST(Pilot, TheParticipantReadsInTheirLanguageAndAFaultOfAFileIsOneSentence) {
    RecordProperty("hazard", "H12");
    const PilotDesk desk;
    const Words few{"--set", "participant=virtual:7", "--seed", "1"};
    const auto speaking = [&](const char* code) { return few + Words{"--set", fmt::format("language={}", code)}; };
    const auto unknown = desk.run("pilot-thresholds", speaking("fr"));
    EXPECT_EQ(unknown.code, 3);
    EXPECT_THAT(unknown.err, HasSubstr("the language is \"fr\"; en, de is expected, or a file words/fr.json"));
    const auto german = desk.run("pilot-thresholds", speaking("de"));
    ASSERT_EQ(german.code, 0) << german.err;
    const auto folder = std::filesystem::path(desk.desk().at("study"));
    const auto study = Study::open(folder, nullptr, Study::Access::Read);
    ASSERT_TRUE(study) << study.error().message;
    const auto rows = study->events(study->sessions().back());
    ASSERT_TRUE(rows);
    const auto plan = std::ranges::find(*rows, std::string("plan"), &SessionRow::name);
    ASSERT_NE(plan, rows->end());
    EXPECT_EQ(plan->body["language"], "de");
    EXPECT_EQ(plan->body["words_sha256"],
              sha256Hex(readTextFile(sourceDir() / "resources/words/de.json", 100'000).value()));

    std::filesystem::create_directories(folder / "words");
    auto own = json::parse(readTextFile(sourceDir() / "resources/words/en.json", 100'000).value());
    own["language"] = "Français";
    const auto write = [&] { std::ofstream(folder / "words/fr.json") << own.dump(); };
    write();
    ASSERT_EQ(desk.run("pilot-thresholds", speaking("fr")).code, 0) << "another language by adding a file";
    const auto listed = jsonOf(desk.desk().run({"study", "words", folder.string(), "--json"}))["words"];
    ASSERT_EQ(listed.size(), 3U);
    const auto read = jsonOf(desk.desk().run({"study", "words", folder.string(), "fr", "--json"}));
    EXPECT_EQ(read["name"], "Français");
    ASSERT_EQ(read["words"].size(), own["words"].size());
    for (const auto& each : read["words"]) EXPECT_EQ(each["text"], own["words"][each["key"].get<std::string>()]);
    own["words"].erase("pain.most");
    write();
    const auto sessions = std::distance(std::filesystem::directory_iterator(folder / "sessions"), {});
    const auto broken = desk.run("pilot-thresholds", speaking("fr"));
    EXPECT_EQ(broken.code, 3);
    EXPECT_THAT(broken.err, HasSubstr("fr.json: \"pain.most\" is missing"));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "sessions"), {}), sessions);
}

TEST(Pilot, ASessionGoesOnInTheWordsThatItWasBegunWith) {
    RecordProperty("hazard", "H8");
    const PilotDesk desk;
    const auto german = shortSession() + Words{"--set", "language=de"};
    ASSERT_EQ(desk.runKilled(300, "pilot-identification", german), -9);
    const Words resume{"--set", "unfinished=resume"};
    const auto other = desk.run("pilot-identification", shortSession() + resume + Words{"--set", "language=en"});
    EXPECT_EQ(other.code, 4);
    EXPECT_THAT(other.err, HasSubstr("was begun with the words de"));
    const auto ran = desk.run("pilot-identification", shortSession() + resume);
    EXPECT_EQ(ran.code, 0) << "its own are taken where none are named: " << ran.err;
}

TEST(Pilot, StudyTrialsSaysWhatIsOpen) {
    const PilotDesk desk;
    ASSERT_EQ(desk.runKilled(400, "pilot-identification", shortSession()), -9);
    const auto shown = jsonOf(desk.desk().run({"study", "show", desk.desk().at("study"), "--json"}));
    const std::string code = shown["participants"][0]["code"];
    const auto ran = desk.desk().run({"study", "trials", desk.desk().at("study"), code, "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto trials = jsonOf(ran);
    EXPECT_EQ(trials["code"], code);
    EXPECT_EQ(trials["session"], 1);
    EXPECT_GT(trials["plan"].size(), 18U);
    EXPECT_LE(trials["open"].size(), 1U) << "at most one trial is begun and not answered";
}

}  // namespace
}  // namespace tacto::test
