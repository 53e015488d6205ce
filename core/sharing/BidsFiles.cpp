#include "core/sharing/BidsFiles.h"

#include <algorithm>
#include <fmt/ranges.h>
#include <functional>
#include <map>
#include <numeric>
#include <utility>

#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Random.h"
#include "core/base/WholeFile.h"
#include "core/sharing/BidsTable.h"
#include "core/study/NextDay.h"

namespace tacto {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kIndent = 2;

std::string textOf(const json& value) { return dumpJson(value, kIndent) + "\n"; }

void addTable(std::vector<BidsFile>& files, const std::string& stem, const BidsTable& table,
              json about = json::object()) {
    about.update(table.sidecar());
    files.push_back({stem + ".tsv", table.tsv()});
    files.push_back({stem + ".json", textOf(about)});
}

/// The numbers of participants and sessions of each basis.
struct Basis {
    explicit Basis(const BidsStudy& study) {
        for (const auto& participant : study.participants) {
            ++participants[participant.basis];
            sessions[participant.basis] += participant.sessions.size();
        }
    }
    [[nodiscard]] bool isAll(SessionBasis one) const { return participants.size() == 1 && participants.contains(one); }
    [[nodiscard]] std::size_t of(SessionBasis one) const {
        const auto found = sessions.find(one);
        return found == sessions.end() ? 0 : found->second;
    }
    /// Returns "SIMULATED" or "SIMULATED IN PART"; empty if there are only people on real devices.
    [[nodiscard]] std::string word() const {
        if (participants.empty() || isAll(SessionBasis::Person)) return {};
        return participants.contains(SessionBasis::Person) ? "SIMULATED IN PART" : "SIMULATED";
    }
    std::map<SessionBasis, std::size_t> participants, sessions;
};

/// If data are simulated, even in part, the title says so, unlike any study of people alone.
std::string titleOf(const BidsStudy& study) {
    const Basis basis(study);
    if (basis.word().empty()) return study.rehearsal ? study.title + " (rehearsal)" : study.title;
    const auto who = basis.isAll(SessionBasis::Virtual)           ? std::string("simulated participants")
                     : basis.isAll(SessionBasis::PersonSimulated) ? std::string("people on simulated devices")
                                                                  : countsText(basis.participants);
    return fmt::format("{} ({}{})", study.title, study.rehearsal ? "rehearsal, " : "", who);
}

/// Returns the approvals, which are only for sessions with people.
json approvalsOf(const BidsStudy& study) {
    const Basis basis(study);
    if (study.rehearsal) return json::array({"none: a rehearsal"});
    if (!basis.participants.empty() && !basis.participants.contains(SessionBasis::Person))
        return json::array({"none: no person took part"});
    return study.approval.empty() ? json::array() : json::array({study.approval});
}

std::string simulatedText(const BidsStudy& study) {
    const Basis basis(study);
    if (basis.word().empty()) return {};
    auto text = fmt::format("{}: basis in participants.tsv and in the tables of sessions says which.", basis.word());
    if (const auto n = basis.of(SessionBasis::Virtual); basis.participants.contains(SessionBasis::Virtual))
        text += fmt::format(
            " {} session(s) are of virtual participants, a model of people, and so is what they felt: "
            "they say what the program does, not what people do.",
            n);
    if (const auto n = basis.of(SessionBasis::PersonSimulated); n > 0)
        text += fmt::format(" {} session(s) were answered by people on simulated devices: nothing was felt.", n);
    if (const auto n = basis.of(SessionBasis::Person); n > 0)
        text += fmt::format(" {} session(s) were answered by people on real devices.", n);
    return text + "\n\n";
}

BidsFile description(const BidsStudy& study, std::string_view version) {
    auto about = bidsDescription(titleOf(study), study.license, version);
    about["EthicsApprovals"] = approvalsOf(study);
    return {"dataset_description.json", textOf(about)};
}

BidsFile readme(const BidsStudy& study) {
    const Basis basis(study);
    std::size_t sessions = 0;
    for (const auto& [one, n] : basis.sessions) sessions += n;
    std::string text = fmt::format(
        "{}\n\nWhether people tell four conditions of tactile stimulation apart: {}, {} session(s).{}\n\n",
        titleOf(study), countsText(basis.participants), sessions,
        study.waiting > 0 ? fmt::format(" {} more are enrolled and have had no session.", study.waiting) : "");
    if (study.massager) {
        text +=
            "Modality: massager. What was felt was the vibration of a motor; levels are its strength, from 0 to 1. "
            "acceleration_m_s2 and the columns after it are what an accelerometer on the motor measured, and n/a where "
            "none was there.\n\n";
    }
    text += simulatedText(study);
    for (const auto& [label, what] : study.particulars) text += fmt::format("{}: {}\n", label, what);
    if (!study.particulars.empty()) text += "\n";
    text +=
        "task-thresholds: ascending limits, detection of one train in one of two intervals, and the personal range.\n"
        "task-identification: which of the conditions was presented; trial_type catch is a presentation of nothing.\n"
        "task-ratings, task-sideeffects: answers to questions.\n\n"
        "Participants are numbered in random order. No file is dated: sessions are placed by the days since the "
        "participant's first one. n/a is a value that was not recorded or does not apply.\n";
    return {"README", text};
}

/// Returns the years from the beginning of the span that contains `least` to the end of the one with `most`. From 89
/// years on there is no upper end, as BIDS recommends, since few people are that old.
std::string ageRange(int least, int most, int width) {
    constexpr int kOldestShared = 89;
    const int from = least / width * width, to = most / width * width + width - 1;
    return to >= kOldestShared ? fmt::format("{}+", from) : fmt::format("{}-{}", from, to);
}

constexpr int kAgeWidths[] = {10, 20, 40};  // years

using AboutForm = std::function<std::string(const BidsAbout&)>;

/// Returns the ways to state an age, narrow ranges first.
std::vector<AboutForm> ageForms(const std::vector<BidsAbout>& people) {
    std::vector<AboutForm> forms;
    const auto add = [&](auto range) {
        forms.emplace_back([range](const BidsAbout& each) {
            const auto years = parseWhole<int>(each.age);
            return years ? range(*years) : std::string();
        });
    };
    for (const int width : kAgeWidths) add([width](int years) { return ageRange(years, years, width); });
    std::vector<int> ages;
    for (const auto& each : people)
        if (const auto years = parseWhole<int>(each.age)) ages.push_back(*years);
    if (ages.empty()) return forms;
    add([least = std::ranges::min(ages), most = std::ranges::max(ages)](int) {
        return ageRange(least, most, kAgeWidths[0]);
    });
    return forms;
}

/// Whether each of these is there at least kMinAlike times.
bool allAlike(const std::vector<BidsAbout>& people) {
    return std::ranges::all_of(people, [&](const BidsAbout& each) {
        return std::cmp_greater_equal(std::ranges::count(people, each), kMinAlike);
    });
}

BidsColumn basisColumn() {
    return {"basis",
            "On whom and what the figures rest",
            "",
            {{std::string(nameOf(SessionBasis::Person)), "a person, on real devices"},
             {std::string(nameOf(SessionBasis::PersonSimulated)),
              "a person answered; the devices were simulated, and nothing was felt"},
             {std::string(nameOf(SessionBasis::Virtual)), "a model of a person, on simulated devices"}}};
}

BidsTable participantsTable(const BidsWith& asked,
                            const std::vector<std::pair<std::string, const BidsParticipant*>>& labelled) {
    std::vector<BidsColumn> columns = {{"participant_id", "Label of the participant, in random order"},
                                       {"species", "Species; n/a for a simulated participant"},
                                       {"group",
                                        "Group of the participant",
                                        "",
                                        {{"intact", "no limb difference"},
                                         {"limb difference", "a limb was lost or never formed"},
                                         {"virtual", "simulated by the program"}}},
                                       {"sessions", "Sessions begun"},
                                       basisColumn()};
    std::vector<BidsAbout> people;
    for (const auto& [label, each] : labelled)
        if (each->basis != SessionBasis::Virtual) people.push_back({each->age, each->sex, each->handedness});
    const auto about = sharedAbout(std::move(people), asked);
    const auto& with = about.columns;
    if (with.age) columns.push_back({"age_range", "Range of years in which the age lies"});
    if (with.sex) columns.push_back({"sex", "female, male or other"});
    if (with.handedness) columns.push_back({"handedness", "right, left or ambidextrous"});
    BidsTable table(std::move(columns));
    auto next = about.people.begin();
    for (const auto& [label, participant] : labelled) {
        const bool isVirtual = participant->basis == SessionBasis::Virtual;
        std::vector<BidsCell> cells = {"sub-" + label, isVirtual ? "" : "homo sapiens",
                                       isVirtual ? "virtual" : participant->group, participant->sessions.size(),
                                       nameOf(participant->basis)};
        const auto said = isVirtual ? BidsAbout() : *next++;
        if (with.age) cells.emplace_back(said.age);
        if (with.sex) cells.emplace_back(said.sex);
        if (with.handedness) cells.emplace_back(said.handedness);
        table.add(std::move(cells));
    }
    return table;
}

std::string sessionLabel(const BidsSession& session) { return fmt::format("ses-{:02}", session.number); }

std::vector<BidsColumn> feltColumns(bool massager) {
    if (massager) {
        return {{"modality", "Through what it was felt", "", {{"massager", "the vibration of a motor"}}},
                {"min_intensity", "Lowest strength of the personal range, 0 to 1"},
                {"max_intensity", "Highest strength of the personal range, 0 to 1"},
                {"detection_intensity", "Detection threshold (80 % right of two intervals)"},
                {"too_strong_intensity", "Lowest strength called too strong, else the highest given"}};
    }
    return {{"electrode_area_cm2", "Area of each electrode", "cm^2"},
            {"impedance_ohm", "Magnitude of the electrodes' impedance at the beginning", "ohm"},
            {"min_ma", "Lowest current of the personal range", "mA"},
            {"max_ma", "Highest current of the personal range", "mA"},
            {"detection_ma", "Detection threshold (80 % right of two intervals)", "mA"},
            {"too_strong_ma", "Lowest current called too strong, else the highest given", "mA"}};
}

std::vector<BidsCell> feltCells(const BidsStudy& study, const BidsSession& session) {
    if (study.massager)
        return {"massager", session.lowIntensity, session.highIntensity, session.detection, session.tooStrong};
    return {study.electrodeArea_cm2, session.impedance, session.low, session.high,
            session.detection,       session.tooStrong};
}

/// Returns text such as "redness:2:4,itching:1:1"; empty if nobody was asked.
std::string sideEffectsNextDay(const BidsSession& session) {
    if (std::ranges::find(session.sideEffectsAsked, kNextDayMoment) == session.sideEffectsAsked.end()) return {};
    const auto rated = [](std::optional<int> rating) { return rating ? std::to_string(*rating) : "n/a"; };
    std::string all;
    for (const auto& each : session.sideEffects) {
        if (each.moment != kNextDayMoment) continue;
        all += fmt::format("{}{}:{}:{}", all.empty() ? "" : ",", each.item, rated(each.severity), rated(each.relation));
    }
    return all.empty() ? "none" : all;
}

BidsTable sessionsTable(const BidsStudy& study, const BidsParticipant& participant) {
    std::vector<BidsColumn> columns = {{"session_id", "Label of the session"},
                                       {"days_since_first", "Whole days since the participant's first session", "d"},
                                       {"encoding", "Which stimulus has which name"},
                                       {"site", "Where the stimulation was applied"}};
    std::ranges::move(feltColumns(study.massager), std::back_inserter(columns));
    const auto skin = "Worse of erythema and oedema: " + scaleText(kSkinScores, 0);
    const std::initializer_list<BidsColumn> more = {
        {"skin_before", skin},
        {"skin_after", skin},
        {"skin_next_day", skin + ", on a later day; n/a where it was not asked"},
        {"side_effects_next_day",
         "On a later day, ITEM:SEVERITY:RELATION with commas between, n/a for what was not rated; none: asked, and "
         "nothing was noticed. "
         "Severity: " +
             scaleText(kSideEffectSeverities) + ". Relation to the stimulation: " + scaleText(kRelations)},
        {"complete", "Whether the session came to its end", "", {{"true", "yes"}, {"false", "no"}}},
        {"parts", "1, and one more for each time it was interrupted and gone on with"},
        {"answers", "The answers at places, keys and buttons 1 to 4, with commas between, in all phases"},
        basisColumn()};
    columns.insert(columns.end(), more.begin(), more.end());
    BidsTable table(std::move(columns));
    for (const auto& session : participant.sessions) {
        std::vector<BidsCell> cells = {sessionLabel(session), session.days, session.encoding, study.site};
        std::ranges::move(feltCells(study, session), std::back_inserter(cells));
        for (const BidsCell& cell :
             {BidsCell(session.skinBefore), BidsCell(session.skinAfter), BidsCell(session.skinNextDay),
              BidsCell(sideEffectsNextDay(session)), BidsCell(session.complete), BidsCell(session.parts),
              BidsCell(session.answers), BidsCell(nameOf(session.basis))})
            cells.push_back(cell);
        table.add(std::move(cells));
    }
    return table;
}

/// Returns what is known of stimulator and electrodes. What a session recorded of its device fills in what is unknown.
json stimulationOf(const BidsStudy& study, const BidsSession& session) {
    auto about = json::object();
    for (const auto& [name, text] : study.stimulation) about[name] = text;
    for (const auto& [name, recorded] :
         {std::pair{"ManufacturersModelName", &session.deviceModel}, {"DeviceSerialNumber", &session.deviceSerial}}) {
        if (!recorded->empty() && textOr(about, name) == kNoWord) about[name] = *recorded;
    }
    if (std::isfinite(study.electrodeArea_cm2)) {
        about["ElectrodeSize"] = study.electrodeArea_cm2;
        about["ElectrodeSizeUnits"] = "cm^2";
    }
    return about;
}

void addSession(std::vector<BidsFile>& files, const std::string& subject, const BidsStudy& study,
                const BidsSession& session) {
    const bool massager = study.massager;
    const auto label = sessionLabel(session);
    const auto stem = fmt::format("{0}/{1}/beh/{0}_{1}_task-", subject, label);
    struct Task {
        const char* name;
        const char* description;
        BidsTable table;
    };
    for (const auto& task :
         {Task{"identification", "Name which of the conditions was presented", identificationTable(session, massager)},
          Task{"thresholds", "Say how strong it is, or which of two intervals held it",
               thresholdsTable(session, massager)},
          Task{"ratings", "Rate each condition, presented without its name", ratingsTable(session)},
          Task{"sideeffects", "Say what is noticed at the skin and otherwise", sideEffectsTable(session, massager)}}) {
        if (task.table.isEmpty()) continue;
        json about{{"TaskName", task.name},
                   {"TaskDescription", task.description},
                   {"Basis", std::string(nameOf(session.basis))}};
        about.update(stimulationOf(study, session));
        addTable(files, fmt::format("{}{}_beh", stem, task.name), task.table, std::move(about));
    }
}

}  // namespace

SharedAbout sharedAbout(std::vector<BidsAbout> people, const BidsWith& asked) {
    SharedAbout out;
    out.people.resize(people.size());
    std::vector<std::string> withheld;
    const auto publish = [&](bool BidsWith::*column, std::string BidsAbout::*member, const char* name,
                             const std::vector<AboutForm>& forms) {
        if (!(asked.*column)) return;
        for (const auto& form : forms) {
            auto tried = out.people;
            for (std::size_t i = 0; i < people.size(); ++i) tried[i].*member = form(people[i]);
            if (!allAlike(tried)) continue;
            out.people = std::move(tried);
            out.columns.*column = true;
            return;
        }
        withheld.emplace_back(name);
    };
    publish(&BidsWith::age, &BidsAbout::age, "age", ageForms(people));
    publish(&BidsWith::sex, &BidsAbout::sex, "sex", {&BidsAbout::sex});
    publish(&BidsWith::handedness, &BidsAbout::handedness, "handedness", {&BidsAbout::handedness});
    if (!withheld.empty())
        out.withheld = fmt::format("{} withheld: fewer than {} people would share what is said of them",
                                   fmt::join(withheld, " and "), kMinAlike);
    return out;
}

Result<BidsWith> bidsWithFrom(std::string_view list) {
    BidsWith with;
    for (const auto each : split(list, ',')) {
        const auto word = trimmed(each);
        if (word == "age") {
            with.age = true;
        } else if (word == "sex") {
            with.sex = true;
        } else if (word == "handedness") {
            with.handedness = true;
        } else {
            return invalid("\"{}\" cannot be exported; age, sex and handedness can", word);
        }
    }
    return with;
}

json bidsDescription(std::string_view name, std::string_view license, std::string_view version) {
    return {{"Name", name},
            {"BIDSVersion", "1.11.1"},
            {"DatasetType", "raw"},
            {"License", license.empty() ? "n/a" : license},
            {"GeneratedBy", json::array({{{"Name", "Tactoscope"}, {"Version", version}}})}};
}

Result<std::string> bidsLabel(const BidsStudy& study, std::size_t enrolled) {
    if (enrolled < 1 || study.places < 1) {
        return invalid("participant {} of a study of {}; both from 1 are accepted", enrolled, study.places);
    }
    // An amendment that allows more people must not change the labels of earlier participants.
    const auto round = (enrolled - 1) / study.places, first = round * study.places;
    std::vector<std::size_t> places(study.places);
    std::iota(places.begin(), places.end(), first + 1);
    Random random(study.labelSeed, fmt::format("labels of participants {}", round));
    for (std::size_t i = places.size(); i > 1; --i) std::swap(places[i - 1], places[random.below(i)]);
    return fmt::format("{:02}", places[enrolled - 1 - first]);
}

Result<std::vector<BidsFile>> bidsFiles(const BidsStudy& study, const BidsWith& with, std::string_view version) {
    std::vector<std::pair<std::string, const BidsParticipant*>> labelled;
    for (const auto& participant : study.participants) {
        const auto label = bidsLabel(study, participant.enrolled);
        if (!label) return failure(label);
        labelled.emplace_back(*label, &participant);
        for (const auto& session : participant.sessions) {
            if (session.number < 1)
                return invalid("session {} of participant {}; a number from 1 is expected", session.number,
                               participant.enrolled);
            if (session.basis != participant.basis)
                return invalid(
                    "session {} of participant {} rests on a {}, and other sessions of theirs on a {}; one "
                    "basis for a participant is expected",
                    session.number, participant.enrolled, nameOf(session.basis), nameOf(participant.basis));
        }
        if (const auto* second = secondIn(participant.sessions, &BidsSession::number)) {
            return invalid("{}", givenTwice("session {} of participant {}", second->number, participant.enrolled));
        }
    }
    std::ranges::sort(labelled);
    if (const auto* second = secondIn(labelled, &decltype(labelled)::value_type::first))
        return invalid("{}", givenTwice("participant {}", second->second->enrolled));
    std::vector<BidsFile> files = {description(study, version), readme(study)};
    addTable(files, "participants", participantsTable(with, labelled));
    for (const auto& [label, participant] : labelled) {
        const auto subject = "sub-" + label;
        addTable(files, fmt::format("{0}/{0}_sessions", subject), sessionsTable(study, *participant));
        for (const auto& session : participant->sessions) addSession(files, subject, study, session);
    }
    std::ranges::sort(files, {}, &BidsFile::path);
    return files;
}

Result<void> checkBidsFolder(const fs::path& folder) {
    std::error_code failed;
    if (!fs::exists(folder, failed) || (fs::is_directory(folder, failed) && fs::is_empty(folder, failed))) return {};
    return invalid("{} holds something already; a new or empty folder is expected", folder.string());
}

Result<void> writeBids(const std::vector<BidsFile>& files, const fs::path& folder) {
    if (auto free = checkBidsFolder(folder); !free) return free;
    for (const auto& file : files) {
        const auto path = folder / file.path;
        std::error_code failed;
        fs::create_directories(path.parent_path(), failed);
        if (failed) return fail(ErrorCode::Io, "{}: {}", path.parent_path().string(), failed.message());
        auto out = FileOut::create(path);
        if (auto written = namedAs(path, out ? out->write(file.text) : failure(out)); !written) return written;
    }
    return {};
}

}  // namespace tacto
