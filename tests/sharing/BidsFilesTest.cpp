#include <algorithm>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <set>

#include "core/base/Csv.h"
#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Random.h"
#include "core/sharing/BidsFiles.h"
#include "tests/support/OtherProgram.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"
#include "tests/support/Trials.h"

namespace tacto {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

BidsTrial trialOf(std::size_t number, std::string condition, std::string response) {
    BidsTrial row;
    row.trial.number = number;
    row.trial.block = 1;
    row.trial.condition = std::move(condition);
    row.trial.response = std::move(response);
    row.trial.rt_s = 0.7312345678;
    row.trial.current = Milliamps(4.5);
    row.trial.interval_s = 0.5;
    row.trial.trains = 9;
    row.voltage = Volts(15.3);
    row.impedance = Ohms(3400);
    row.detection = 2.1;
    return row;
}

BidsSession sessionOf(std::size_t number, double days) {
    BidsSession session;
    session.number = number;
    session.days = days;
    session.encoding = "standard";
    session.impedance = Ohms(3400);
    session.low = Milliamps(3);
    session.high = Milliamps(6.5);
    session.detection = 2.1;
    session.skinBefore = 0;
    session.complete = number == 1;
    session.labels = {"smooth-low", "smooth-high", "rough-low", "rough-high"};
    session.trials = {trialOf(41, "rough-high", "rough-high"), trialOf(42, "smooth-low", "not-sure"),
                      trialOf(43, "catch", "none"), trialOf(44, "catch", "rough-low"), trialOf(45, "rough-low", "")};
    session.trials[2].trial.current = Milliamps(0);
    session.thresholds = {{.number = 1,
                           .procedure = "ascending",
                           .series = 1,
                           .type = "catch",
                           .current = Milliamps(0),
                           .response = "nothing"},
                          {.number = 1,
                           .procedure = "detection",
                           .type = "second",
                           .current = Milliamps(2.5),
                           .response = "first",
                           .correct = false,
                           .response_s = 0.9}};
    session.ratings = {{"naturalness", "rough-high", "rather-unnatural"}, {"qualities", "rough-high", "tapping,touch"}};
    session.sideEffects = {{"after", "tingling", 2, 5}};
    return session;
}

BidsStudy studyOfThree() {
    BidsStudy study;
    study.title = "Four conditions";
    study.approval = "EK 2026/117, Ethics Committee";
    study.site = "upper arm";
    study.electrodeArea_cm2 = 4;
    study.places = 5;
    study.labelSeed = 99;
    for (std::size_t i = 1; i <= 3; ++i) {
        BidsParticipant participant;
        participant.enrolled = i;
        participant.group = i == 2 ? "limb difference" : "intact";
        participant.age = "34";
        participant.sessions = {sessionOf(1, 0), sessionOf(2, 7)};
        study.participants.push_back(std::move(participant));
    }
    return study;
}

void restOn(BidsParticipant& participant, SessionBasis basis) {
    participant.basis = basis;
    for (auto& session : participant.sessions) session.basis = basis;
}

std::map<std::string, std::string> filesOf(const BidsStudy& study, const BidsWith& with = {}) {
    const auto files = bidsFiles(study, with, "1.2.3");
    EXPECT_TRUE(files) << files.error().message;
    std::map<std::string, std::string> out;
    if (files) {
        for (const auto& file : *files) EXPECT_TRUE(out.emplace(file.path, file.text).second) << file.path;
    }
    return out;
}

std::vector<std::vector<std::string>> tableOf(const std::string& tsv) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(tsv);
    for (std::string line; std::getline(lines, line);) {
        rows.emplace_back();
        for (const auto cell : split(line, '\t')) rows.back().emplace_back(cell);
    }
    return rows;
}

TEST(BidsFiles, NamesAreThoseOfTheDesign) {
    std::set<std::string> tasks;
    for (const auto& [path, text] : filesOf(studyOfThree())) {
        static const std::regex session(R"(sub-(\d\d)/ses-0[12]/beh/sub-\1_ses-0[12]_task-(\w+)_beh\.(tsv|json))");
        std::smatch found;
        if (std::regex_match(path, found, session)) tasks.insert(found[2]);
    }
    EXPECT_EQ(tasks, (std::set<std::string>{"identification", "ratings", "sideeffects", "thresholds"}));
}

TEST(BidsFiles, EachTableIsWholeAndEachColumnInItsSidecar) {
    const auto files = filesOf(studyOfThree(), {.age = true, .sex = true, .handedness = true});
    std::size_t tables = 0;
    for (const auto& [path, text] : files) {
        if (!path.ends_with(".tsv")) continue;
        ++tables;
        const auto rows = tableOf(text);
        ASSERT_GE(rows.size(), 2U) << path;
        const auto sidecar = parseJson(files.at(path.substr(0, path.size() - 4) + ".json"), path);
        ASSERT_TRUE(sidecar) << path;
        for (const auto& column : rows[0]) {
            EXPECT_TRUE(sidecar->contains(column)) << path << ": " << column;
            EXPECT_NE(column, "onset") << path;
            EXPECT_NE(column, "duration") << path;
        }
        for (const auto& row : rows) {
            EXPECT_EQ(row.size(), rows[0].size()) << path;
            for (const auto& cell : row) EXPECT_FALSE(cell.empty() || cell == "nan") << path;
        }
    }
    EXPECT_EQ(tables, 1U + 3 * (1 + 2 * 4));
}

TEST(BidsFiles, TrialsSayWhatWasPresentedAndAnswered) {
    const auto files = filesOf(studyOfThree());
    const auto label = "sub-" + bidsLabel(studyOfThree(), 1).value_or("");
    const auto rows = tableOf(files.at(label + "/ses-01/beh/" + label + "_ses-01_task-identification_beh.tsv"));
    const std::vector<std::string> columns = {"trial",   "block",         "phase",        "encoding",  "trial_type",
                                              "texture", "pressure",      "response",     "correct",   "response_time",
                                              "attempt", "current_ma",    "intensity",    "voltage_v", "interval_s",
                                              "trains",  "impedance_ohm", "detection_ma", "adapted"};
    EXPECT_EQ(rows[0], columns);
    EXPECT_EQ(rows[1], (std::vector<std::string>{"41", "1", "test", "standard", "rough-high", "rough", "high",
                                                 "rough-high", "true", "0.731235", "1", "4.5", "n/a", "15.3", "0.5",
                                                 "9", "3400", "2.1", "false"}));
    EXPECT_EQ(rows[2][7], "not_sure");
    EXPECT_EQ(rows[2][8], "false");
    EXPECT_EQ(rows[3][4], "catch");
    EXPECT_EQ(rows[3][5], "n/a");
    EXPECT_EQ(rows[3][8], "true");   // nothing was presented, and nothing was felt
    EXPECT_EQ(rows[4][8], "false");  // nothing was presented, but something was named
    EXPECT_EQ(rows[5][7], "n/a");
    EXPECT_EQ(rows[5][8], "n/a");
}

TEST(BidsFiles, NothingIsDatedAndOnlyWhatIsAskedForIsIdentifying) {
    RecordProperty("hazard", "H11");
    static const std::regex date(R"((19|20)\d\d-\d\d|\d\d:\d\d)");
    for (const auto& [path, text] : filesOf(studyOfThree())) EXPECT_FALSE(std::regex_search(text, date)) << path;
    EXPECT_EQ(tableOf(filesOf(studyOfThree()).at("participants.tsv"))[0],
              (std::vector<std::string>{"participant_id", "species", "group", "sessions", "basis"}));
    const auto with = tableOf(filesOf(studyOfThree(), {.age = true}).at("participants.tsv"));
    EXPECT_EQ(with[0].back(), "age_range");
    EXPECT_EQ(with[1].back(), "30-39");
}

TEST(BidsFiles, NobodyCanBeToldByAgeSexAndHandedness) {
    RecordProperty("hazard", "H11");
    Random random(49, "published ages");
    const auto drawn = [&](std::span<const std::string_view> words) {
        return std::string(words[random.below(words.size())]);
    };
    for (int trial = 0; trial < 2000; ++trial) {
        std::vector<BidsAbout> people(random.below(9));
        for (auto& each : people) {
            if (random.below(8) > 0) each.age = std::to_string(18 + random.below(trial % 3 == 0 ? 100 : 20));
            each.sex = random.below(9) > 0 ? drawn(std::span(kSexes).first(2)) : "";
            each.handedness = random.below(4) > 0 ? "right" : drawn(kHandednesses);
        }
        const BidsWith asked{random.below(3) > 0, random.below(2) > 0, random.below(2) > 0};
        const auto shared = sharedAbout(people, asked);
        ASSERT_EQ(shared.people.size(), people.size());
        EXPECT_FALSE((shared.columns.age && !asked.age) || (shared.columns.sex && !asked.sex));
        std::map<std::string, int> alike;
        for (std::size_t i = 0; i < people.size(); ++i) {
            const auto& said = shared.people[i];
            ++alike[said.age + '|' + said.sex + '|' + said.handedness];
            if (!said.age.empty()) {
                const int age = std::stoi(people[i].age), from = std::stoi(said.age);
                EXPECT_GE(age, from);
                const auto hyphen = said.age.find('-');
                if (hyphen == std::string::npos) {
                    EXPECT_EQ(said.age.back(), '+') << said.age;
                } else {
                    EXPECT_LE(age, std::stoi(said.age.substr(hyphen + 1)));
                    EXPECT_LT(std::stoi(said.age.substr(hyphen + 1)), 89) << "few people are older";
                }
            }
            EXPECT_EQ(said.sex, shared.columns.sex ? people[i].sex : "");
            EXPECT_EQ(said.handedness, shared.columns.handedness ? people[i].handedness : "");
        }
        const bool any = shared.columns.age || shared.columns.sex || shared.columns.handedness;
        for (const auto& [what, n] : alike) EXPECT_TRUE(!any || n >= 3) << what;
        const bool all = shared.columns.age == asked.age && shared.columns.sex == asked.sex &&
                         shared.columns.handedness == asked.handedness;
        EXPECT_EQ(shared.withheld.empty(), all) << shared.withheld;
    }
    const std::vector<BidsAbout> three{{"24", "female", "right"}, {"31", "male", "right"}, {"57", "female", "right"}};
    const auto shared = sharedAbout(three, {true, true, true});
    EXPECT_EQ(shared.people[1], (BidsAbout{"20-59", "", "right"}));
    EXPECT_EQ(shared.withheld, "sex withheld: fewer than 3 people would share what is said of them");
}

TEST(BidsFiles, LabelsAreShuffledAndStayWhenMoreAreEnrolled) {
    auto study = studyOfThree();
    const auto first = filesOf(study);
    EXPECT_EQ(first, filesOf(study));
    std::vector<std::string> labels;
    for (std::size_t i = 1; i <= 5; ++i) labels.push_back(bidsLabel(study, i).value_or(""));
    EXPECT_THAT(labels, testing::UnorderedElementsAre("01", "02", "03", "04", "05"));
    study.participants.pop_back();
    for (std::size_t i = 1; i <= 2; ++i) EXPECT_EQ(bidsLabel(study, i).value_or(""), labels[i - 1]);
    bool inOrder = true;
    for (std::uint64_t seed = 1; seed < 4; ++seed) {
        study.labelSeed = seed;
        inOrder = inOrder && bidsLabel(study, 1).value_or("") == "01" && bidsLabel(study, 2).value_or("") == "02";
    }
    EXPECT_FALSE(inOrder);
}

TEST(BidsFiles, MoreParticipantsThanTheFirstApprovalAllowedChangeNoLabel) {
    RecordProperty("hazard", "H8");
    auto study = studyOfThree();
    study.places = 2;
    const auto label = [&](std::size_t enrolled) { return bidsLabel(study, enrolled).value_or(""); };
    EXPECT_THAT((std::vector{label(1), label(2)}), testing::UnorderedElementsAre("01", "02"));
    EXPECT_THAT((std::vector{label(3), label(4)}), testing::UnorderedElementsAre("03", "04"));
    EXPECT_THAT((std::vector{label(5), label(6)}), testing::UnorderedElementsAre("05", "06"));
}

TEST(BidsFiles, SimulatedParticipantsAreCalledSo) {
    RecordProperty("hazard", "H9");
    auto study = studyOfThree();
    for (auto& participant : study.participants) restOn(participant, SessionBasis::Virtual);
    const auto files = filesOf(study);
    EXPECT_THAT(files.at("dataset_description.json"), HasSubstr("simulated"));
    EXPECT_THAT(files.at("README"), HasSubstr("SIMULATED"));
    const auto rows = tableOf(files.at("participants.tsv"));
    EXPECT_EQ(rows[1][1], "n/a");
    EXPECT_EQ(rows[1][2], "virtual");
}

TEST(BidsFiles, WhatIsSimulatedSaysSoInEachNameCountAndRow) {
    RecordProperty("hazard", "H8");
    Random random(1848, "mixed exports");
    for (int trial = 0; trial < test::trials<int>({.local = 200, .ci = 1000, .campaign = 10'000}); ++trial) {
        auto study = studyOfThree();
        study.rehearsal = random.below(3) == 0;
        study.participants.clear();
        study.places = 9;
        std::map<SessionBasis, std::size_t> people, sessions;
        study.waiting = random.below(3);
        const auto all = 1 + random.below(9);
        for (std::size_t i = 1; i <= all; ++i) {
            BidsParticipant one;
            one.enrolled = i;
            one.group = "intact";
            const auto count = 1 + random.below(2);
            for (std::size_t number = 1; number <= count; ++number) one.sessions.push_back(sessionOf(number, 0));
            restOn(one, kSessionBases[random.below(3)].value);
            ++people[one.basis];
            sessions[one.basis] += count;
            study.participants.push_back(std::move(one));
        }
        const auto files = filesOf(study);
        const auto& readme = files.at("README");
        SCOPED_TRACE(readme);
        EXPECT_EQ(readme.find("have had no session") != std::string::npos, study.waiting > 0);
        const auto about = *parseJson(files.at("dataset_description.json"), "description");
        const auto name = about.at("Name").get<std::string>();
        const bool only = people.size() == 1 && people.contains(SessionBasis::Person);
        EXPECT_EQ(name == study.title, only && !study.rehearsal) << name;
        EXPECT_EQ(name.find("rehearsal") != std::string::npos, study.rehearsal) << name;
        EXPECT_EQ(readme.find("SIMULATED") != std::string::npos, !only);
        EXPECT_EQ(about.at("EthicsApprovals") == json::array({study.approval}),
                  people.contains(SessionBasis::Person) && !study.rehearsal);
        for (const auto& [basis, n] : people) {
            const auto counted = fmt::format("{} {}", n, peopleOf(basis, n));
            EXPECT_THAT(readme, HasSubstr(counted));
            if (people.size() > 1) {
                EXPECT_THAT(name, HasSubstr(counted));
            }
            if (!only && sessions[basis] > 0) {
                EXPECT_THAT(readme, HasSubstr(fmt::format("{} session(s)", sessions[basis])));
            }
        }
        const auto rows = tableOf(files.at("participants.tsv"));
        ASSERT_EQ(rows[0][4], "basis");
        for (std::size_t i = 1; i <= all; ++i) {
            const auto label = rows[i][0];
            const auto one = std::ranges::find_if(study.participants, [&](const BidsParticipant& each) {
                return "sub-" + *bidsLabel(study, each.enrolled) == label;
            });
            EXPECT_EQ(rows[i][4], nameOf(one->basis));
            EXPECT_EQ(rows[i][1] == "homo sapiens", one->basis != SessionBasis::Virtual);
            const auto each = tableOf(files.at(fmt::format("{0}/{0}_sessions.tsv", label)));
            ASSERT_EQ(each[0].back(), "basis");
            for (std::size_t row = 1; row < each.size(); ++row) EXPECT_EQ(each[row].back(), nameOf(one->basis));
            const auto task = fmt::format("{0}/ses-01/beh/{0}_ses-01_task-identification_beh.json", label);
            EXPECT_EQ(parseJson(files.at(task), task)->at("Basis"), nameOf(one->basis));
        }
    }
}

TEST(BidsFiles, AParticipantOfTwoBasesIsRefused) {
    RecordProperty("hazard", "H8");
    auto study = studyOfThree();
    study.participants[1].sessions[1].basis = SessionBasis::Virtual;
    EXPECT_EQ(
        bidsFiles(study, {}, "1.2.3").error().message,
        "session 2 of participant 2 rests on a virtual participant, and other sessions of theirs on a person; one "
        "basis for a participant is expected");
}

TEST(BidsFiles, DescriptionHasTheFieldsOfTheDesign) {
    const auto about = test::accepted(parseJson(filesOf(studyOfThree()).at("dataset_description.json"), "description"));
    EXPECT_EQ(about.at("Name"), "Four conditions");
    EXPECT_EQ(about.at("BIDSVersion"), "1.11.1");
    EXPECT_EQ(about.at("DatasetType"), "raw");
    EXPECT_EQ(about.at("EthicsApprovals"), json::array({"EK 2026/117, Ethics Committee"}));
    EXPECT_EQ(about.at("GeneratedBy"), json::parse(R"([{"Name": "Tactoscope", "Version": "1.2.3"}])"));
    EXPECT_EQ(about.at("License"), "n/a");
    auto licensed = studyOfThree();
    licensed.license = "CC-BY-4.0";
    EXPECT_EQ(parseJson(filesOf(licensed).at("dataset_description.json"), "description")->at("License"), "CC-BY-4.0");
}

TEST(BidsFiles, ATextNeverBeginsAnotherCell) {
    auto study = studyOfThree();
    study.participants[0].sessions[0].ratings[0].value = "tab\there\nand there";
    const auto label = "sub-" + bidsLabel(study, 1).value_or("");
    EXPECT_THAT(filesOf(study).at(label + "/ses-01/beh/" + label + "_ses-01_task-ratings_beh.tsv"),
                HasSubstr("tab here and there"));
}

TEST(BidsFiles, RefusesWhatCannotBeNumbered) {
    auto study = studyOfThree();
    study.places = 0;
    EXPECT_EQ(bidsFiles(study, {}, "1").error().message, "participant 1 of a study of 0; both from 1 are accepted");
    study = studyOfThree();
    study.participants[1].enrolled = 1;
    EXPECT_EQ(bidsFiles(study, {}, "1").error().message, "participant 1 is given twice; once is expected");
    study = studyOfThree();
    study.participants[1].sessions[1].number = 1;
    EXPECT_EQ(bidsFiles(study, {}, "1").error().message, "session 1 of participant 2 is given twice; once is expected");
    EXPECT_EQ(bidsWithFrom("age,name").error().message, "\"name\" cannot be exported; age, sex and handedness can");
    EXPECT_TRUE(bidsWithFrom("sex, handedness")->handedness);
}

TEST(BidsFiles, WhatIsKnownOfStimulatorAndElectrodesStandsInEachSidecar) {
    auto study = studyOfThree();
    study.stimulation = {{"Manufacturer", "unknown"}, {"DeviceSerialNumber", "unknown"}, {"ElectrodeShape", "ring"}};
    study.particulars = {{"Objectives", "to find the range"}};
    study.participants[0].sessions[0].deviceSerial = "P24-7";
    const auto files = filesOf(study);
    EXPECT_THAT(files.at("README"), HasSubstr("Objectives: to find the range\n"));
    std::size_t sidecars = 0, known = 0;
    for (const auto& [path, text] : files) {
        if (!path.ends_with("_beh.json")) continue;
        ++sidecars;
        const auto about = *parseJson(text, path);
        EXPECT_EQ(about.at("Manufacturer"), "unknown");
        EXPECT_EQ(about.at("ElectrodeShape"), "ring");
        EXPECT_EQ(about.at("ElectrodeSize"), 4);
        known += about.at("DeviceSerialNumber") == "P24-7";
    }
    EXPECT_EQ(sidecars, 24U);
    EXPECT_EQ(known, 4U) << "as the session recorded it";
}

TEST(BidsFiles, AFolderThatHoldsSomethingIsLeftAlone) {
    const test::ScratchDir folder;
    const std::vector<BidsFile> files = {{"a/b.txt", "text"}};
    ASSERT_TRUE(writeBids(files, folder.path() / "new"));
    EXPECT_EQ(readTextFile(folder.path() / "new/a/b.txt").value_or(""), "text");
    EXPECT_THAT(writeBids(files, folder.path() / "new").error().message, HasSubstr("holds something already"));
    EXPECT_FALSE(writeBids(files, folder.path() / "new/a/b.txt"));
}

TEST(BidsFiles, DebiansValidatorAcceptsEveryPath) {
    const std::string python = "/usr/bin/python3";
    if (test::outputOf(python + " -c 'import bids_validator'").second != 0) GTEST_SKIP() << "no python3-bids-validator";
    const test::ScratchDir folder;
    const auto files = bidsFiles(studyOfThree(), {}, "1.2.3");
    ASSERT_TRUE(files);
    ASSERT_TRUE(writeBids(*files, folder.path() / "bids"));
    const auto script = folder.path() / "check.py";
    std::ofstream(script) << R"(import pathlib, sys
from bids_validator import BIDSValidator
root = pathlib.Path(sys.argv[1])
paths = ["/" + str(path.relative_to(root)) for path in sorted(root.rglob("*")) if path.is_file()]
refused = [path for path in paths if not BIDSValidator(index_associated=False).is_bids(path)]
assert not BIDSValidator().is_bids("/sub-01/ses-01/beh/sub-02_ses-01_task-identification_beh.tsv")
print(len(paths), "files, refused:", refused)
sys.exit(1 if refused else 0)
)";
    const auto [said, code] =
        test::outputOf(fmt::format("{} '{}' '{}'", python, script.string(), (folder.path() / "bids").string()));
    EXPECT_EQ(code, 0) << said;
    EXPECT_THAT(said, HasSubstr(fmt::format("{} files", files->size())));
}

TEST(BidsFiles, TheDayAfterStandsInTheSessionsTableAndItsSidecar) {
    RecordProperty("hazard", "H12");
    auto study = studyOfThree();
    auto& sessions = study.participants[0].sessions;
    ASSERT_EQ(sessions.size(), 2U);
    sessions[0].skinNextDay = 1;
    sessions[0].sideEffectsAsked = {"before", "next day"};
    sessions[0].sideEffects = {{"before", "pain", 2, 1}, {"next day", "redness", 2, 4}, {"next day", "itching", 3, 5}};
    const auto cells = [&](const char* column) {
        const auto files = filesOf(study);
        const auto stem =
            fmt::format("sub-{0}/sub-{0}_sessions", bidsLabel(study, study.participants[0].enrolled).value());
        const auto rows = tableOf(files.at(stem + ".tsv"));
        const auto at = static_cast<std::size_t>(std::ranges::find(rows[0], column) - rows[0].begin());
        std::vector<std::string> found;
        for (std::size_t row = 1; row < rows.size() && at < rows[0].size(); ++row) found.push_back(rows[row][at]);
        EXPECT_FALSE(json::parse(files.at(stem + ".json")).at(column).at("Description").get<std::string>().empty());
        return found;
    };
    EXPECT_EQ(cells("skin_next_day"), (std::vector<std::string>{"1", "n/a"}));
    EXPECT_EQ(cells("side_effects_next_day"), (std::vector<std::string>{"redness:2:4,itching:3:5", "n/a"}));
    sessions[0].sideEffects = {{"next day", "redness", std::nullopt, 4}};
    EXPECT_EQ(cells("side_effects_next_day").front(), "redness:n/a:4") << "not rated is not 0";
    sessions[0].sideEffects.clear();
    EXPECT_EQ(cells("side_effects_next_day"), (std::vector<std::string>{"none", "n/a"})) << "asked is not n/a";
    for (const auto& [path, text] : filesOf(study)) {
        if (!path.ends_with("_sessions.json")) continue;
        EXPECT_THAT(text, HasSubstr("1 absent, 2 mild, 3 moderate, 4 severe"));
        EXPECT_THAT(text, HasSubstr("0 none, 1 very slight, 2 well defined, 3 moderate, 4 severe"));
    }
}

TEST(BidsFiles, WithAMassagerThereAreStrengthsAndNeverCurrentsOrVoltages) {
    RecordProperty("hazard", "H9");
    auto study = studyOfThree();
    study.massager = true;
    study.electrodeArea_cm2 = kNaN;
    for (auto& participant : study.participants) {
        for (auto& session : participant.sessions) {
            session.low = session.high = Milliamps(kNaN);
            session.impedance = Ohms(kNaN);
            session.lowIntensity = 0.3;
            session.highIntensity = 0.55;
            session.tooStrong = 0.7;
            for (auto& row : session.trials) {
                row.intensity = row.trial.condition == "catch" ? 0 : 0.55;
                row.trial.current = Milliamps(kNaN);
            }
            session.trials[0].vibration.strength_m_s2 = 2.125;
        }
    }
    const auto files = filesOf(study);
    EXPECT_THAT(files.at("README"), HasSubstr("Modality: massager"));
    for (const auto& [path, text] : files) {
        for (const char* electrical : {"_ma", "mA", "voltage", "impedance", "lectrode", "current"})
            EXPECT_THAT(text, testing::Not(HasSubstr(electrical))) << path;
    }
    for (const auto& [path, text] : files) {
        if (!path.ends_with("_sessions.tsv")) continue;
        const auto rows = tableOf(text);
        EXPECT_EQ(rows[0][4], "modality") << path;
        EXPECT_EQ(rows[1][4], "massager");
        EXPECT_EQ(rows[0][5], "min_intensity");
        EXPECT_EQ(rows[1][5], "0.3");
        EXPECT_EQ(rows[1][8], "0.7");
    }
    for (const auto& [path, text] : files) {
        if (!path.ends_with("task-identification_beh.tsv")) continue;
        const auto rows = tableOf(text);
        const auto at = [&](const char* name) {
            return static_cast<std::size_t>(std::ranges::find(rows[0], name) - rows[0].begin());
        };
        ASSERT_LT(at("acceleration_m_s2"), rows[0].size()) << path;
        EXPECT_EQ(rows[1][at("intensity")], "0.55");
        EXPECT_EQ(rows[1][at("acceleration_m_s2")], "2.125");
        EXPECT_EQ(rows[2][at("acceleration_m_s2")], "n/a") << "not measured is not zero";
        EXPECT_EQ(rows[1][at("detection_intensity")], "2.1");
    }
}

}  // namespace
}  // namespace tacto
