#include "app/run/PilotRun.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "app/run/MachineGate.h"
#include "app/run/StudyProgram.h"
#include "core/analysis/identification/Encodings.h"
#include "core/base/JsonFields.h"
#include "core/base/SystemTime.h"
#include "core/session/ResultKind.h"
#include "core/session/SessionReader.h"

namespace tacto {

namespace {

using nlohmann::json;

constexpr std::string_view kVirtual = "virtual:";
constexpr const char *kMethod = "method", *kComparison = "comparison";

std::string textOf(const RunOrder& order, const char* name) { return textOr(order.settings.parameters, name); }

/// What the script is to do: what was chosen, else what the study was approved for. What a script does not declare it
/// does not do, and that is approved.
AskedProcedure askedProcedure(RunOrder& order, const std::optional<StudyProcedure>& approved) {
    auto& parameters = order.settings.parameters;
    const auto isOpen = [&](const char* name) {
        return approved && parameters.contains(name) && !order.settings.chosen.contains(name);
    };
    if (isOpen(kMethod)) parameters[kMethod] = nameOf(approved->method);
    if (isOpen(kComparison)) parameters[kComparison] = approved->comparison ? "yes" : "no";
    AskedProcedure asked;
    asked.method = valueFor(kDetectionMethods, textOf(order, kMethod)).value_or(DetectionMethod::Quest);
    asked.comparison =
        parameters.contains(kComparison) ? textOf(order, kComparison) == "yes" : approved && approved->comparison;
    return asked;
}

/// A number as it was declared; NaN where the script declares none of that name.
double numberOf(const RunOrder& order, const char* name) { return numberOr(order.settings.parameters, name); }

Result<std::optional<std::uint64_t>> virtualSeed(const std::string& participant) {
    if (!participant.starts_with(kVirtual)) return std::optional<std::uint64_t>();
    const auto digits = std::string_view(participant).substr(kVirtual.size());
    std::uint64_t seed = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), seed);
    if (error == std::errc() && end == digits.data() + digits.size()) return std::optional(seed);
    return fail(ErrorCode::NotFound, "the participant is \"{}\"; virtual: and a whole number from 0 is expected",
                participant);
}

bool isSimulated(const DeviceUri& uri) { return uri.scheme == "sim"; }

bool isMassager(const DeviceUri& uri) { return uri.scheme == "hid" || (isSimulated(uri) && uri.path == "massager"); }

/// As the settings say; nothing where they leave it to the study.
std::optional<Modality> wantedModality(const RunOrder& order) {
    return valueFor(kModalities, textOf(order, "modality"));
}

/// `sim:` is a current source with the P24's grid, unless it says otherwise.
void fitSource(DeviceUri& uri) {
    if (!isSimulated(uri) || (!uri.path.empty() && uri.path != "stimulator")) return;
    const auto has = [&uri](std::string_view key) {
        return std::ranges::any_of(uri.parameters, [key](const auto& each) { return each.first == key; });
    };
    if (has("mode")) return;
    uri.parameters.emplace_back("mode", "current");
    if (!has("step")) uri.parameters.emplace_back("step", "0.5mA");
}

PersonSetup stimulated(const Participant& who, const StudySettings& study, const Profile& profile) {
    PersonSetup person;
    person.participant = who.code;
    person.consentRecorded = !who.consents.empty();
    person.discomfortLimit = Milliamps(2 * study.cap_mA);  // Until something is called too strong; the cap is lower
    person.rampStep = Milliamps(1);
    person.cap = Milliamps(study.cap_mA);
    person.impedanceLow = profile.loadLow;
    person.impedanceHigh = profile.loadHigh;
    return person;
}

/// Levels rise by one step, and no current is permitted.
PersonSetup vibrated(const Participant& who) {
    PersonSetup person;
    person.participant = who.code;
    person.consentRecorded = !who.consents.empty();
    person.vibration = PersonVibration{.discomfortLimit = 1, .rampStep = kIntensityStep};
    return person;
}

/// A virtual participant's answers to the checklist: no to every item except the one that the settings name.
Result<std::vector<ExclusionAnswer>> simulatedAnswers(const RunOrder& order) {
    auto answers = nothingExcludes();
    const auto yes = textOf(order, "exclusions");
    if (yes.empty()) return answers;
    const auto at = std::ranges::find(answers, yes, &ExclusionAnswer::key);
    if (at == answers.end()) {
        std::vector<std::string> keys;
        for (const auto& answer : answers) keys.push_back(answer.key);
        return fail(ErrorCode::InvalidArgument, "exclusions is \"{}\"; one of {} is expected", yes,
                    fmt::join(keys, ", "));
    }
    at->yes = true;
    return answers;
}

/// One without a usable range is complete, and has no such trial.
bool wasTested(const Study& study, const StudySession& session) {
    const auto rows = pilotRows(study, session);
    if (!rows) return false;
    return std::ranges::any_of(pilotTrials(rows->events).trials,
                               [](const IdentificationTrial& trial) { return trial.phase == TrialPhase::Test; });
}

}  // namespace

PilotRun::~PilotRun() {
    run_.reset();  // the script first: it calls the session
}

// The study

Result<void> PilotRun::openStudy(const RunOrder& order, const PilotOrder& pilot) {
    const auto participant = textOf(order, "participant");
    if (participant.empty())
        return fail(ErrorCode::NotFound, "no participant is named; --set participant=CODE or virtual:SEED is expected");
    if (pilot.study.empty())
        return fail(ErrorCode::NotFound, "no study is named; --out with the study's folder is expected");
    const auto seed = virtualSeed(participant);
    if (!seed) return failure(seed);
    const bool simulated = std::ranges::all_of(order.uris, isSimulated);
    if (*seed && !simulated)
        return fail(kGateRefused, "{} is a virtual participant; only simulated devices are accepted", participant);
    if (!Study::isThere(pilot.study)) {
        if (!*seed)
            return fail(ErrorCode::NotFound, "there is no study in {}; study create makes one", pilot.study.string());
        StudySettings settings;
        const bool massager = std::ranges::any_of(order.uris, isMassager);
        settings.modality = wantedModality(order).value_or(massager ? Modality::Massager : Modality::Electrodes);
        auto made = Study::createRehearsal(pilot.study, std::move(settings));
        if (!made) return failure(made);
        study_.emplace(std::move(*made));
        remarks_.push_back("A rehearsal was made in " + pilot.study.string() + "; its participants are simulated.");
    } else {
        auto opened = Study::open(pilot.study, pilot.passphrase ? &*pilot.passphrase : nullptr, Study::Access::Change);
        if (!opened) return failure(opened);
        study_.emplace(std::move(*opened));
        if (!study_->hasKey())
            return fail(ErrorCode::NotFound, "the study in {} is sealed; --passphrase-file is expected",
                        pilot.study.string());
    }
    const auto modality = study_->settings().modality;
    if (const auto wanted = wantedModality(order); wanted && *wanted != modality)
        return fail(kGateRefused, "modality is {}; {}, that of the study in {}, is expected", nameOf(*wanted),
                    nameOf(modality), pilot.study.string());
    auto found = study_->find(participant);
    const bool byItself = *seed && study_->isRehearsal();
    if (!found && byItself) {
        Participant enrolled;
        enrolled.virtualSeed = *seed;
        found = study_->enrol(std::move(enrolled));
        if (!found) return failure(found);
    }
    // Also one whose enrolment alone is on disk, because the program died before the consent was.
    if (found && byItself && found->consents.empty()) {
        const Consent consent{study_->settings().consentVersion, study_->today(), "simulated"};
        if (auto given = study_->consent(found->code, consent); !given) return given;
        found = study_->find(participant);
        if (!found) return failure(found);
        remarks_.push_back(participant + " was enrolled as " + found->code +
                           " and consented by itself, as it does in rehearsals only.");
    }
    if (!found) return failure(found);
    who_ = std::move(*found);
    if (!who_.virtualSeed && pilot.people == nullptr)
        return fail(ErrorCode::NotFound, "{} is a person, who needs the window: tactoscope, Pilot", who_.code);
    if (!study_->isRehearsal() && order.settings.given.contains("blocks"))
        return fail(kGateRefused, "the number of blocks is the study's, {}; --set blocks is for rehearsals",
                    study_->settings().blocks);
    return {};
}

Result<void> PilotRun::chooseSession(const RunOrder& order) {
    unfinished_ = study_->unfinished(who_.id);
    if (!unfinished_) return {};
    const auto wanted = textOf(order, "unfinished");
    if (wanted != "end" && wanted != "resume")
        return fail(ErrorCode::NotFound,
                    "session {} of {} ({}) is unfinished; --set unfinished=resume or unfinished=end is expected",
                    unfinished_->number, who_.code, unfinished_->protocol);
    auto rows = pilotRows(*study_, *unfinished_);
    if (wanted == "end") {  // also one that can no longer be read
        // Complete where the program was ended before the study knew.
        const bool complete = rows && rows->ended == PilotEnd::Complete;
        toEnd_ = SessionToEnd{*std::exchange(unfinished_, std::nullopt),
                              complete ? StudySessionState::Complete : StudySessionState::Stopped};
        return {};
    }
    if (unfinished_->protocol != order.script.name)
        return fail(ErrorCode::NotFound, "session {} of {} is of {}; it goes on with that protocol, or ends with {}",
                    unfinished_->number, who_.code, unfinished_->protocol, whatEnds());
    if (!rows) return failure(rows);
    earlier_ = std::move(*rows);
    return mayResume();
}

std::string_view PilotRun::whatEnds() const { return inWindow_ ? "“End it as stopped”" : "--set unfinished=end"; }

Result<void> PilotRun::mayResume() const {
    const auto now = SystemTime::real().wall();
    if (earlier_.mayGoOn(now)) {
        if (auto approved = study_->stillApproved(); !approved) return approved;
        return clockGate(earlier_.answeredAt, now, "what was last presented or answered");
    }
    return fail(kGateRefused,
                "session {} of {} was interrupted {:.1f} h ago; it can go on within 2 h, and ends with {}",
                unfinished_->number, who_.code,
                std::chrono::duration<double, std::ratio<3600>>(now - earlier_.answeredAt).count(), whatEnds());
}

/// What was too strong, and the range, were found with the first part's device and hold for no other.
Result<void> PilotRun::sameDevice(const DeviceSet& devices) const {
    if (!earlier_.delivers) return {};
    const auto& begun = *earlier_.delivers;
    const auto& now = devices.stimulator ? devices.stimulator->identity() : devices.massager->identity();
    if (now.name == begun.name && now.serial == begun.serial) return {};
    const auto named = [](const std::string& name, const std::string& serial) {
        return serial.empty() ? name : name + " " + serial;
    };
    return fail(kGateRefused,
                "session {} of {} was begun with {} and {} is connected; it goes on with the former, or ends with {}",
                unfinished_->number, who_.code, named(begun.name, begun.serial), named(now.name, now.serial),
                whatEnds());
}

/// Levels hold for one kind of train, and answers of two procedures do not make one result.
Result<void> PilotRun::sameProcedure() const {
    if (earlier_.runSha256.empty() || earlier_.runSha256 == settings_.runSha256) return {};
    return fail(kGateRefused,
                "session {} of {} was begun with a profile, method and settings that hash to {:.12}…, and those of now "
                "hash to {:.12}…; it goes on with the former, or ends with {}",
                unfinished_->number, who_.code, earlier_.runSha256, settings_.runSha256, whatEnds());
}

// The bench

Result<VirtualObserver> PilotRun::observerFor(const RunOrder& order) const {
    PopulationModel model;
    const auto take = [&order](double& into, const char* name) {
        if (const double value = numberOf(order, name); std::isfinite(value)) into = value;
    };
    take(model.detection_ma.median, "detection");
    take(model.attention_ma.median, "attention");
    take(model.discomfort_ma, "discomfort");
    take(model.intolerance_ma.median, "intolerance");
    take(model.noise_jnd, "noise");
    if (auto sound = validate(model); !sound) return failure(sound);
    const auto& study = study_->settings();
    VirtualObserverSettings settings;
    settings.who = drawParticipant(model, *who_.virtualSeed, 0, Micros(study.train.width_us), study.electrode.area);
    settings.seed = *who_.virtualSeed;
    take(settings.adaptation, "adaptation");
    settings.unit = settings_.unit;
    return VirtualObserver::create(settings);
}

/// Each person has a study's encodings in an order of their own (Encodings.h), one a session; one whose session was not
/// completed comes again.
void PilotRun::chooseEncoding() {
    const auto& offered = study_->settings().encodings;
    settings_.encoding = offered.empty() ? "standard" : offered.front();
    if (offered.size() < 2) return;
    std::vector<std::string> had;
    for (const auto& session : study_->sessions()) {
        if (session.participant != who_.id) continue;
        if (resultTraits(session.protocol).kind != ResultKind::PilotIdentification) continue;
        if (session.state == StudySessionState::Complete && wasTested(*study_, session))
            had.push_back(session.encoding);
    }
    const auto order = williamsOrder(offered.size(), static_cast<std::size_t>(std::max(1, who_.enrolled) - 1));
    settings_.encoding = unfinished_ ? unfinished_->encoding : offered[order[had.size() % order.size()]];
    for (const auto& each : had) {
        if (each != settings_.encoding) settings_.earlierEncoding = each;
    }
}

void PilotRun::fitOrder(RunOrder& order, const PilotOrder& pilot) {
    const auto& study = study_->settings();
    auto& profile = order.profile;
    const bool massager = study.modality == Modality::Massager;
    request_.procedure = procedureOf(profile, study, askedProcedure(order, study.procedure));
    if (!massager) fitProfile(profile, study);

    settings_.code = who_.code;
    settings_.runSha256 = runHash(study, request_.procedure);
    settings_.isVirtual = who_.virtualSeed.has_value();
    settings_.session = unfinished_ ? unfinished_->number : who_.sessions + 1;
    if (earlier_.seed) order.seed = *earlier_.seed;  // The session's seed replaces the command's
    settings_.seed = order.seed;
    chooseEncoding();
    settings_.unit = massager ? LevelUnit::Intensity : LevelUnit::Current;
    settings_.cap = massager ? 1 : study.cap_mA;
    settings_.shortest = profile.encoding.intervalMin;
    settings_.longest = profile.encoding.intervalMax;
    settings_.window = 2 * settings_.longest;
    settings_.assignment = settings_.encoding == "swapped" ? Assignment::Swapped : profile.encoding.assignment;
    settings_.conditions = profile.encoding.conditions;
    settings_.blocks = study.blocks;
    if (order.settings.given.contains("blocks")) settings_.blocks = static_cast<int>(numberOf(order, "blocks"));
    settings_.perCondition = study.perCondition;
    settings_.catchTrials = study.catchTrials;

    order.mode = OutputMode::Person;
    order.person = massager ? vibrated(who_) : stimulated(who_, study, profile);
    order.virtualParticipant = settings_.isVirtual;
    order.rehearsal = study_->isRehearsal();
    order.realtime = order.realtime || pilot.people != nullptr;
    if (order.uris.empty()) order.uris.push_back({"sim", "", {}});
    if (massager)
        order.ownNeeds = {Role::Massager};
    else
        std::ranges::for_each(order.uris, fitSource);
    order.makeSession = [this, profile, limits = order.limits](const SessionAbout& about, const Clock& clock,
                                                               const DeviceSet& devices) -> Result<RunSession> {
        if (auto holds = machineGate(study_->settings(), profile, limits, devices, utcToday()); !holds)
            return failure(holds);
        if (auto same = sameDevice(devices); !same) return failure(same);
        if (auto same = sameProcedure(); !same) return failure(same);
        return makeSession(about, clock, devices);
    };

    request_.code = who_.code;
    request_.script = {order.script.name, order.script.sha256};
    request_.encoding = settings_.encoding;
    request_.codeConfirmed = pilot.codeConfirmed || settings_.isVirtual;
    request_.exclusions = pilot.exclusions;
    if (!settings_.isVirtual) return;
    if (auto answers = simulatedAnswers(order)) request_.exclusions = std::move(*answers);
}

Result<RunSession> PilotRun::makeSession(const SessionAbout& about, const Clock& clock, const DeviceSet& devices) {
    request_.devicesSimulated = std::ranges::all_of(devices.identities(), &DeviceIdentity::simulated);
    if (toEnd_) {  // Not before every gate lets another begin: until then it can be continued
        if (auto may = study_->mayBegin(request_); !may) return failure(may);
        const auto& [session, state] = *toEnd_;
        if (auto ended = study_->endSession(session.id, state, ""); !ended) return failure(ended);
        remarks_.push_back(fmt::format("Session {} of {} was ended as {}.", session.number, who_.code, nameOf(state)));
    }
    auto begun = unfinished_ ? study_->continueSession(unfinished_->id, request_) : study_->beginSession(request_);
    if (!begun) return failure(begun);
    begun_ = std::move(*begun);
    auto writer = SessionWriter::create(begun_->path, about, clock, begun_->seal);
    if (!writer) return failure(writer);
    RunSession made;
    made.files.session = begun_->path;
    made.writer = std::move(*writer);
    made.seal = begun_->seal;
    return made;
}

Result<std::unique_ptr<PilotRun>> PilotRun::prepare(RunOrder order, PilotOrder pilot, Registry& registry,
                                                    std::shared_ptr<BenchTap> tap) {
    std::unique_ptr<PilotRun> made(new PilotRun());
    made->inWindow_ = pilot.people != nullptr;
    if (pilot.markers) {
        auto listens = MarkerServer::listen(*pilot.markers);
        if (!listens) return failure(listens);
        made->markers_ = std::move(*listens);
    }
    const auto answers = simulatedAnswers(order);
    if (!answers) return failure(answers);
    if (textOf(order, "participant").starts_with(kVirtual)) {  // Before a rehearsal is made for it
        if (auto held = exclusionGate(*answers); !held) return failure(held);
    }
    if (auto opened = made->openStudy(order, pilot); !opened) return failure(opened);
    SessionRequest answered;  // whatever refuses afterwards
    answered.code = made->who_.code;
    answered.exclusions = pilot.exclusions;
    if (auto noted = made->study_->noteExclusions(answered); !noted) return failure(noted);
    if (auto chosen = made->chooseSession(order); !chosen) return failure(chosen);
    made->fitOrder(order, pilot);
    const VirtualObserver* truth = nullptr;
    PilotParticipant* people = pilot.people;
    if (made->settings_.isVirtual) {
        auto observer = made->observerFor(order);
        if (!observer) return failure(observer);
        order.ownLoad = observer->settings().who.skin.text();
        std::vector<std::string> names;
        for (const auto& each : made->settings_.conditions) names.push_back(each.name);
        made->virtual_ = std::make_unique<VirtualPilotParticipant>(std::move(*observer), std::move(names));
        truth = &made->virtual_->observer();
        if (people == nullptr) people = made->virtual_.get();
    }
    auto run = ProtocolRun::prepare(std::move(order), registry, std::move(tap));
    if (!run) {
        made->cancelBooked();
        return failure(run);
    }
    made->run_ = std::move(*run);
    const auto& opened = made->run_->opened();
    made->record_ = std::make_unique<PilotRecord>(*opened.session, *opened.clock, made->earlier_.events);
    if (made->markers_) {
        made->markers_->begin(opened.clock);
        made->record_->onMarker = [to = made->markers_](const PilotMarker& each) { to->send(each.at, each.name); };
    }
    const auto parts = static_cast<int>(made->begun_->session.parts.size());
    made->session_ =
        std::make_unique<PilotSession>(made->run_->bench(), *people, *made->record_, made->settings_, truth, parts);
    if (made->unfinished_) made->session_->resumesFrom(made->unfinished_->parts.back().file, made->earlier_.chainHead);
    auto* raw = made.get();
    made->session_->mayGoOn = [raw] { return raw->mayGoOn(); };
    made->session_->care().skinReacted = [raw](const std::string& moment, int score) {
        return raw->noteSkin(moment, score);
    };
    return made;
}

/// A session whose bench could not be opened is not one that may go on. A continued session stays as it was.
void PilotRun::cancelBooked() {
    if (!begun_ || unfinished_) return;
    static_cast<void>(study_->cancelSession(begun_->session.id));
}

/// Still approved, and within the time that a session may take, from its first part on.
Result<void> PilotRun::mayGoOn() const {
    if (auto approved = study_->stillApproved(); !approved) return approved;
    const double most_min = study_->settings().sessionMax_min;
    const double taken_min =
        std::chrono::duration<double, std::ratio<60>>(SystemTime::real().wall() - begun_->session.parts.front().begun)
            .count();
    if (taken_min < most_min) return {};
    return fail(kGateRefused,
                "the session has taken {:.0f} min; the study allows {:.0f} min, so no further block begins", taken_min,
                most_min);
}

/// In the ledger, which a withdrawal leaves. How severe it is and what it comes from is the investigator's to say:
/// until then it counts as what it may be at worst.
Result<void> PilotRun::noteSkin(const std::string& moment, int score) {
    AdverseEvent event;
    event.what = fmt::format(
        "skin at the {} scored {} of 4 ({}); severity and relation as noted by the program, for "
        "the investigator to judge",
        settings_.modality(), score, moment);
    event.severity = severityOfSkin(score);
    event.relation = 5;
    const auto& session = begun_->session.id;
    const auto noted = study_->adverseEvents();
    if (!noted) return failure(noted);
    const bool known = std::ranges::any_of(*noted, [&](const auto& each) {
        return each.first == session && each.second.what == event.what;  // before it was interrupted and resumed
    });
    return known ? Result<void>() : study_->adverseEvent(session, event);
}

Result<void> PilotRun::start(RunRequest hooks) {
    hooks.pilot = session_.get();
    return run_->start(std::move(hooks));
}

/// Once no row with a marker is written any more.
std::optional<MarkerTally> PilotRun::endMarkers() {
    if (!markers_) return std::nullopt;
    const bool ended = run_->script() == nullptr || !run_->script()->wait().abandoned;
    const auto tally = markers_->end();
    if (ended) {
        const auto& opened = run_->opened();  // a row that cannot be written is found when the session is closed
        static_cast<void>(opened.session->event(opened.clock->now(), "markers", toJson(tally)));
    }
    return tally;
}

RunResult PilotRun::finish() {
    session_->stage().participant().leave();  // their STOP must not find a bench that is gone
    const auto markers = endMarkers();
    auto result = run_->finish();
    result.markers = markers;
    const auto ended = session_->stage().ended();
    if (result.outcome.abandoned || ended == PilotEnd::Unfinished) return result;
    std::string head;
    if (const auto reader = SessionReader::open(begun_->path, begun_->seal)) head = reader->chainHead();
    const auto state = ended == PilotEnd::Complete ? StudySessionState::Complete : StudySessionState::Stopped;
    if (auto noted = study_->endSession(begun_->session.id, state, head); !noted) {
        result.troubles.push_back(noted.error());
        if (!result.outcome.error) result.outcome.error = noted.error();
    }
    return result;
}

}  // namespace tacto
