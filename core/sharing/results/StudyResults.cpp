#include "core/sharing/results/StudyResults.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include "core/analysis/identification/IdentificationJson.h"
#include "core/analysis/psychophysics/AscendingLimits.h"
#include "core/analysis/vibration/VibrationSeparability.h"
#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"
#include "core/encoding/EncodingProfile.h"
#include "core/pilot/PilotRecord.h"
#include "core/session/SessionReader.h"

namespace tacto {

namespace {

std::vector<std::string> conditionNames() {
    std::vector<std::string> names;
    for (const auto& condition : EncodingProfile::fourConditions(0, 1)) names.push_back(condition.name);
    return names;
}

Result<SessionRecord> readSession(const Study& study, const StudySession& about) {
    SessionRecord record;
    record.about = about;
    std::vector<SessionRow> commands;
    std::string deviceModel, deviceSerial;
    for (const auto& part : about.parts) {
        const auto file = study.part(part.file);
        if (!file) return failure(file);
        if (!*file) continue;  // booked, but never begun
        for (const auto& device : (*file)->about().devices) {
            if (!device.is(Role::Stimulator) && !device.is(Role::Massager)) continue;
            deviceModel = device.name;
            deviceSerial = device.serial;
        }
        auto rows = (*file)->events();
        if (!rows) return failure(rows);
        std::ranges::move(*rows, std::back_inserter(record.rows));
        auto given = (*file)->commands();
        if (!given) return failure(given);
        std::ranges::move(*given, std::back_inserter(commands));
    }
    record.exposure = exposureOf(commands);
    record.results = sessionResults(record.rows, conditionNames());
    if (const auto said = study.nextDay(about.id)) {
        record.results.sideEffectsAsked.emplace_back(kNextDayMoment);
        record.results.skinNextDay = said->skin();
        for (const auto& each : said->sideEffects)
            record.results.sideEffects.push_back({kNextDayMoment, each.item, each.severity, each.relation});
    }
    record.results.deviceModel = std::move(deviceModel);
    record.results.deviceSerial = std::move(deviceSerial);
    record.results.basis = about.basis;
    record.results.number = static_cast<std::size_t>(about.number);
    record.results.complete = about.state == StudySessionState::Complete;
    record.results.parts = about.parts.size();
    if (record.results.encoding.empty()) record.results.encoding = about.encoding;
    return record;
}

/// Returns the calendar days between the starts of two sessions.
double daysBetween(const StudySession& first, const StudySession& other) {
    const auto dayOf = [](const StudySession& session) {
        return std::chrono::floor<std::chrono::days>(session.parts.front().begun);
    };
    return static_cast<double>((dayOf(other) - dayOf(first)).count());
}

}  // namespace

namespace {
bool wasOpened(const SessionRecord& session) { return session.about.opened; }
}  // namespace

SessionExposure exposureOf(const std::vector<SessionRow>& commands) {
    SessionExposure out;
    const auto known = [](double value) { return std::isfinite(value) ? value : 0; };
    for (const auto& row : commands) {
        if (row.name != "delivered") continue;
        ++out.trains;
        out.stimulated_s += known(numberOr(row.body, "interval_s"));
        constexpr double kMilliampSecondsToMicrocoulombs = 1000;
        out.charge_uC += known(numberOr(row.body, "amplitude_ma") * numberOr(row.body, "width_s") *
                               numberOr(row.body, "pulses") * kMilliampSecondsToMicrocoulombs);
    }
    return out;
}

void leaveOutUnfinished(StudyRecord& study) {
    for (auto& each : study.participants) {
        std::erase_if(each.sessions, [](const SessionRecord& session) {
            return session.about.state == StudySessionState::Unfinished;
        });
    }
}

Result<StudyRecord> readStudyRecord(const Study& study) {
    if (!study.hasKey()) {
        return fail(ErrorCode::Unsupported, "{} was opened without its key; results need its passphrase",
                    study.folder().string());
    }
    StudyRecord out;
    out.settings = study.settings();
    out.rehearsal = study.isRehearsal();
    out.ledgerHead = study.ledgerHead();
    const auto seed = study.labelSeed();
    if (!seed) return failure(seed);
    out.labelSeed = *seed;
    out.places = study.firstPlaces();
    out.amendments = study.amendments();
    out.goingsBack = study.goingsBack();
    const auto sessions = study.sessions();
    for (const auto& session : sessions) out.bases.emplace(session.id, session.basis);
    for (const auto& participant : study.participants()) {
        ParticipantRecord record{participant, study.basisOf(participant), {}};
        for (const auto& session : sessions) {
            if (session.participant != participant.id || participant.state == ParticipantState::Withdrawn) continue;
            auto read = readSession(study, session);
            if (!read) return failure(read);
            if (!session.parts.empty()) {
                const auto& first = record.sessions.empty() ? session : record.sessions.front().about;
                read->results.days = daysBetween(first, session);
            }
            record.sessions.push_back(std::move(*read));
        }
        out.participants.push_back(std::move(record));
    }
    auto events = study.adverseEvents();
    if (!events) return failure(events);
    out.events = std::move(*events);
    out.notes = study.notes();
    return out;
}

std::vector<std::pair<SessionBasis, StudyRecord>> byBasis(const StudyRecord& study) {
    std::vector<std::pair<SessionBasis, StudyRecord>> all;
    for (const auto& [word, basis] : kSessionBases) {
        const auto isOf = [&, one = basis](const ParticipantRecord& participant) { return participant.basis == one; };
        if (std::ranges::none_of(study.participants, isOf)) continue;
        auto& part = all.emplace_back(basis, study).second;
        std::erase_if(part.participants, std::not_fn(isOf));
        std::erase_if(part.events, [&, one = basis](const auto& event) {
            const auto found = study.bases.find(event.first);
            return found == study.bases.end() ? all.size() > 1 : found->second != one;  // unknown: in the first part
        });
    }
    if (all.empty()) all.emplace_back(study.rehearsal ? SessionBasis::Virtual : SessionBasis::Person, study);
    return all;
}

bool isOfElectrodes(const StudyLogField& field) noexcept {
    const std::string_view key = field.key;
    return field.exported != nullptr && !key.starts_with("stimulator") && key != "medication" &&
           key != "concurrent_task";
}

bool mayBeShared(const Participant& participant, bool hadSession) {
    return hadSession && participant.state != ParticipantState::Withdrawn && !participant.consents.empty();
}

BidsStudy sharedStudy(const StudyRecord& record) {
    const auto& settings = record.settings;
    BidsStudy out;
    out.title = settings.title;
    out.rehearsal = record.rehearsal;
    out.approval = settings.approval.committee.empty()
                       ? settings.approval.reference
                       : fmt::format("{}, {}", settings.approval.reference, settings.approval.committee);
    const bool electrodes = settings.modality == Modality::Electrodes;
    out.massager = !electrodes;
    out.site = std::string(nameOf(settings.site));
    if (electrodes) out.electrodeArea_cm2 = settings.electrode.area.value();
    out.license = settings.license;
    out.labelSeed = record.labelSeed;
    out.places = static_cast<std::size_t>(std::max(1, record.places > 0 ? record.places : settings.participantsMax));
    for (const auto& participant : record.participants) {
        const auto& about = participant.about;
        if (!mayBeShared(about, std::ranges::any_of(participant.sessions, wasOpened))) {
            if (about.state != ParticipantState::Withdrawn) ++out.waiting;
            continue;
        }
        BidsParticipant shared;
        shared.enrolled = static_cast<std::size_t>(std::max(0, about.enrolled));
        shared.group = std::string(wordFor<ParticipantGroup>(kParticipantGroups, about.group));
        shared.basis = participant.basis;
        shared.age = about.age;
        shared.sex = about.sex;
        shared.handedness = about.handedness;
        for (const auto& session : participant.sessions) shared.sessions.push_back(session.results);
        out.participants.push_back(std::move(shared));
    }
    const auto known = particularsOf(record.notes);
    for (const auto& field : (*studyLogKind(kParticulars))->fields) {
        if (isOfElectrodes(field) && !electrodes) continue;
        if (field.exported != nullptr)
            out.stimulation.emplace_back(field.exported, known.text(field.key));
        else
            out.particulars.emplace_back(field.label, known.text(field.key));
    }
    if (electrodes) {
        const auto stored = studyFields().write(settings);
        out.stimulation.emplace_back("ElectrodeType", settings.electrode.type);
        out.stimulation.emplace_back("Nerve", textOr(stored, "nerve"));
        out.stimulation.emplace_back("BodySide", textOr(stored, "limb"));
    }
    return out;
}

SharedAbout sharedAbout(const Study& study, const BidsWith& asked) {
    std::vector<BidsAbout> people;
    const auto sessions = study.sessions();
    for (const auto& one : study.participants()) {
        const bool had = std::ranges::any_of(sessions, [&](const StudySession& session) {
            return session.participant == one.id && session.opened && session.basis != SessionBasis::Virtual;
        });
        if (mayBeShared(one, had)) people.push_back({one.age, one.sex, one.handedness});
    }
    return sharedAbout(std::move(people), asked);
}

namespace {

using nlohmann::json;

/// Splits a name at its last word: "detection 12" becomes {"detection", "12"}.
std::pair<std::string, std::string> lastWordOf(const std::string& name) {
    const auto blank = name.rfind(' ');
    if (blank == std::string::npos) return {name, {}};
    return {name.substr(0, blank), name.substr(blank + 1)};
}

/// Returns the answer to a question of any kind.
std::string saidIn(const json& body) {
    if (const auto keys = textsOr(body, "keys"); !keys.empty()) return fmt::format("{}", fmt::join(keys, ","));
    if (const auto key = textOr(body, "key"); !key.empty()) return key;
    const double value = numberOr(body, "value");
    return std::isfinite(value) ? fmt::format("{:g}", value) : std::string();
}

/// Goes through the rows in one pass; each trial gets the last values measured before it.
class SessionRows {
public:
    explicit SessionRows(std::vector<std::string> labels) { out_.labels = std::move(labels); }

    void take(const SessionRow& each) {
        const auto& body = each.body;
        const auto name = textOr(body, "name");
        if (each.name == row::kPlan) {
            auto plan = planRowFrom(body);
            out_.encoding = std::move(plan.encoding);
            out_.answers = std::move(plan.answers);
        } else if (each.name == row::kImpedance) {
            impedance_ = numberOr(body, "impedance_ohm");
            if (std::isnan(out_.impedance.value())) out_.impedance = Ohms(impedance_);
        } else if (each.name == row::kEstimate && body.contains("amplitude_weber")) {
            // An estimate at the edge of the considered range may lie anywhere beyond, so there is no figure.
            if (!flagOr(body, "at_edge")) out_.amplitudeWeber = estimateFrom(body["amplitude_weber"]).value;
        } else if (each.name == row::kEstimate) {
            const auto estimate =
                flagOr(body, "at_edge") ? Estimate{kNaN, kNaN, kNaN} : estimateFrom(valueOr(body, "estimate"));
            out_.detection = detectionLevel_ = estimate.value;
            out_.detectionLow = estimate.low;
            out_.detectionHigh = estimate.high;
        } else if (each.name == row::kDrift) {
            const auto found = driftRowFrom(body);
            detectionLevel_ = found.detection.value;
            if (found.adapted) adapted_.insert(found.block);
            out_.drift.push_back(
                {found.block, detectionLevel_, found.adapted, found.detection.low, found.detection.high});
        } else if (each.name == row::kRange) {
            takeRange(rangeRowFrom(body));
        } else if (each.name == row::kSkin) {
            takeSkin(name, body);
        } else if (each.name == row::kRating) {
            const auto [condition, item] = lastWordOf(name);
            out_.ratings.push_back({item, condition == row::kEncodings ? "" : condition, saidIn(body)});
        } else if (each.name == row::kSideEffect) {
            takeSideEffect(name, body);
        } else if (each.name == row::kPhase && name == row::meantName(calledTooStrong_) && saidIn(body) == "no") {
            out_.tooStrong = beforeTooStrong_;  // a slip, taken back
        } else if (each.name == row::kPhase && name.starts_with("measure again ") && saidIn(body) == "yes") {
            ++out_.measurements;
            series_.clear();  // measured anew; what was too strong stays
            out_.detection = out_.detectionLow = out_.detectionHigh = detectionLevel_ = kNaN;
            beforeLevel_ = highestLevel_ = kNaN;
        } else if (each.name == row::kAnswer) {
            takeAnswer(name, body);
        } else if (each.name == row::kNoAnswer && countOr(body, "number") > 0) {
            silent_.insert_or_assign(countOr(body, "number"), trialOf(body));
        }
    }

    [[nodiscard]] BidsSession result() {
        for (const auto& [number, trial] : silent_) out_.trials.push_back(trial);
        out_.saidTooStrong = std::isfinite(out_.tooStrong);
        if (!out_.saidTooStrong) out_.tooStrong = highestLevel_;
        out_.felt = feltFrom();
        return std::move(out_);
    }

private:
    [[nodiscard]] BidsTrial trialOf(const json& body) const {
        BidsTrial made;
        made.trial = identificationTrialFrom(body);
        const auto& trial = made.trial;
        made.intensity = numberOr(body, "intensity");
        if (body.contains("vibration")) made.vibration = burstFiguresFrom(body["vibration"]);
        made.impedance = Ohms(impedance_);
        made.voltage = Volts(trial.current.value() * impedance_ / 1000);
        made.detection = detectionLevel_;
        made.adapted = trial.phase == TrialPhase::Test && adapted_.contains(trial.block);
        return made;
    }

    void takeAnswer(const std::string& name, const json& body) {
        if (countOr(body, "number") > 0) {
            auto made = trialOf(body);
            silent_.erase(made.trial.number);
            out_.trials.push_back(std::move(made));
            return;
        }
        const auto [procedure, place] = lastWordOf(name);
        BidsThresholdTrial trial;
        trial.procedure = procedure;
        trial.measurement = out_.measurements;
        trial.current = Milliamps(numberOr(body, "current_ma"));
        trial.intensity = numberOr(body, "intensity");
        trial.response = textOr(body, "response");
        trial.response_s = numberOr(body, "rt_s");
        if (procedure == "ascending") {
            takeAscending(trial, name, body);
        } else if (procedure == "detection" || procedure == "drift" || procedure == "comparison") {
            trial.weaker = numberOr(body, body.contains("weaker_ma") ? "weaker_ma" : "weaker_intensity");
            trial.type = textOr(body, "right");
            trial.correct = trial.response == trial.type;
        } else if (procedure == "range") {
            trial.type = "stimulus";
        } else {
            return;  // presented again, without a question
        }
        const auto dot = place.find('.');
        if (dot != std::string::npos)
            trial.series = static_cast<std::size_t>(parseWhole<int>(place.substr(0, dot)).value_or(0));
        trial.number = static_cast<std::size_t>(
            parseWhole<int>(dot == std::string::npos ? place : place.substr(dot + 1)).value_or(0));
        out_.thresholds.push_back(std::move(trial));
    }

    /// `tooStrong` is the lowest level called too strong, else the highest level given. The answer to an empty
    /// presentation counts for the level before it.
    void takeAscending(BidsThresholdTrial& trial, const std::string& name, const json& body) {
        trial.series = countOr(body, "series");
        const double level = std::isfinite(trial.intensity) ? trial.intensity : trial.current.value();
        trial.type = level > 0 ? "stimulus" : "catch";
        if (level > 0) {
            beforeLevel_ = level;
            highestLevel_ = std::isnan(highestLevel_) ? level : std::max(highestLevel_, level);
            if (const auto word = strengthWordFrom(trial.response))  // not a stop
                series_[trial.series].insert_or_assign(level, *word != StrengthWord::Nothing);
        }
        if (trial.response != "too-strong") return;
        const double strong = level > 0 ? level : beforeLevel_;
        calledTooStrong_ = name;
        beforeTooStrong_ = out_.tooStrong;
        out_.tooStrong = std::isnan(out_.tooStrong) ? strong : std::min(out_.tooStrong, strong);
    }

    /// Median over the series of the lowest level that was felt, by the last answer about each level.
    [[nodiscard]] double feltFrom() const {
        std::vector<double> first;
        for (const auto& [number, levels] : series_) {
            const auto found = std::ranges::find_if(levels, [](const auto& level) { return level.second; });
            if (found != levels.end()) first.push_back(found->first);
        }
        return statisticsOf(first).median;
    }

    void takeRange(const RangeRow& found) {
        if (found.unit == LevelUnit::Intensity) {
            out_.lowIntensity = found.min;
            out_.highIntensity = found.max;
        } else {
            out_.low = Milliamps(found.min);
            out_.high = Milliamps(found.max);
            out_.rangeImpedance = found.impedance;
        }
        out_.rangeNotUsable.clear();
        if (!found.usable) out_.rangeNotUsable = found.reason.empty() ? "it was not confirmed" : found.reason;
    }

    void takeSkin(const std::string& name, const json& body) {
        const auto moment = lastWordOf(name).first;
        auto* const score = moment == "before" ? &out_.skinBefore : moment == "after" ? &out_.skinAfter : nullptr;
        const auto said = parseWhole<int>(textOr(body, "key"));
        if (score == nullptr || !said) return;
        *score = std::max(score->value_or(0), *said);
    }

    void takeSideEffect(const std::string& name, const json& body) {
        if (body.contains("keys")) {
            out_.sideEffectsAsked.push_back(name);
            for (const auto& item : textsOr(body, "keys")) out_.sideEffects.push_back({name, item, {}, {}});
            return;
        }
        const double value = numberOr(body, "value");
        if (!std::isfinite(value)) return;
        const auto [noticed, what] = lastWordOf(name);
        const auto [moment, item] = lastWordOf(noticed);
        const auto same = [&](const BidsSideEffect& each) { return each.moment == moment && each.item == item; };
        const auto entry = std::ranges::find_if(out_.sideEffects, same);
        if (entry == out_.sideEffects.end()) return;
        (what == "severity" ? entry->severity : entry->relation) = static_cast<int>(std::lround(value));
    }

    BidsSession out_;
    double impedance_ = kNaN;
    double detectionLevel_ = kNaN;
    double beforeLevel_ = kNaN, highestLevel_ = kNaN;       // levels in the ascending limits
    std::string calledTooStrong_;                           // the last trial that was called too strong
    double beforeTooStrong_ = kNaN;                         // the lowest level called too strong before it
    std::map<std::size_t, std::map<double, bool>> series_;  // of the ascending limits: level, whether it was felt
    std::set<std::size_t> adapted_;                         // block numbers
    std::map<std::size_t, BidsTrial> silent_;               // the last attempt of trials that have no answer yet
};

}  // namespace

BidsSession sessionResults(const std::vector<SessionRow>& rows, std::vector<std::string> labels) {
    SessionRows taken(std::move(labels));
    for (const auto& each : rows) taken.take(each);
    return taken.result();
}

Result<void> exportBids(Study& study, const BidsWith& with, const std::filesystem::path& out,
                        std::string_view version) {
    const auto record = readStudyRecord(study);
    if (!record) return failure(record);
    const auto files = bidsFiles(sharedStudy(*record), with, version);
    if (!files) return failure(files);
    if (auto free = checkBidsFolder(out); !free) return free;
    if (auto noted = study.exported(std::filesystem::absolute(out), "bids"); !noted) return noted;
    return writeBids(*files, out);
}

}  // namespace tacto
