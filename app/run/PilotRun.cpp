#include "app/run/PilotRun.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "app/run/EncodingTurn.h"
#include "app/run/MachineGate.h"
#include "app/run/StudyProgram.h"
#include "app/run/VirtualPerson.h"
#include "core/base/Clock.h"
#include "core/base/JsonText.h"
#include "core/pilot/StudyWords.h"
#include "core/session/SessionReader.h"
#include "core/study/LedgerEnd.h"

namespace tacto {

namespace {

constexpr const char *kMethod = "method", *kComparison = "comparison", *kLanguage = "language";

std::string textOf(const RunOrder& order, const char* name) { return textOr(order.settings.parameters, name); }

/// Returns the script's task: the chosen procedure, else the study's approved procedure. A script does only what it
/// declares, and the declaration is approved.
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

/// Returns the value of a declared number; NaN if the script declares no such parameter.
double numberOf(const RunOrder& order, const char* name) { return numberOr(order.settings.parameters, name); }

/// Makes `sim:` a current source with the P24's grid, unless the address says otherwise.
void fitSource(DeviceUri& uri) {
    if (uri.scheme != "sim" || (!uri.path.empty() && uri.path != "stimulator")) return;
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
    person.discomfortLimit = Milliamps(2 * study.cap_mA);  // until something is called too strong; the cap is lower
    person.rampStep = Milliamps(1);
    person.cap = Milliamps(study.cap_mA);
    person.impedanceLow = profile.loadLow;
    person.impedanceHigh = profile.loadHigh;
    return person;
}

constexpr Seconds kLongestScreen{1};     // at a pace
constexpr Seconds kBetweenScreens{0.1};  // as fast as possible, more screens could not be read

/// Hands the screens of a virtual participant on to `watch` at `pace`.
auto watching(PilotParticipant& watch, double pace, std::shared_ptr<const Clock> clock) {
    return [&watch, pace, clock = std::move(clock), shown = Instant(0),
            at = std::chrono::steady_clock::time_point()](const PilotScreen& screen) mutable {
        const auto now = clock->now();
        if (pace > 0) {
            std::this_thread::sleep_for(std::min(kLongestScreen, Seconds(now - shown) / pace));
            shown = now;
        } else if (clock->isVirtual()) {
            const auto time = std::chrono::steady_clock::now();
            if (time - at < kBetweenScreens) return;
            at = time;
        }
        watch.show(screen);
    };
}

/// Returns the words on the target that a virtual participant would touch, who learns what it is told by name; empty
/// where nothing is felt or asked.
std::string likelyAnswerOf(VirtualPilotParticipant& who, const FeltPresentation& felt, const PilotPrompt& prompt) {
    who.delivered(felt);
    if (!(felt.level > 0) || prompt.targets.empty()) return {};
    const auto said = who.ask(prompt);
    if (!said) return {};
    const auto found = std::ranges::find(prompt.targets, said->key(), &PromptTarget::key);
    return found == prompt.targets.end() ? std::string() : found->text;
}

/// Levels rise one step at a time, and no current is permitted.
PersonSetup vibrated(const Participant& who) {
    PersonSetup person;
    person.participant = who.code;
    person.consentRecorded = !who.consents.empty();
    person.vibration = PersonVibration{.discomfortLimit = 1, .rampStep = kIntensityStep};
    return person;
}

}  // namespace

PilotRun::PilotRun(OpenedStudy opened, std::shared_ptr<MarkerServer> markers)
    : study_(std::move(opened.study)),
      who_(std::move(opened.who)),
      remarks_(std::move(opened.remarks)),
      markers_(std::move(markers)) {}

PilotRun::~PilotRun() {
    run_.reset();  // the script first, because it calls the session
}

void PilotRun::fitOrder(RunOrder& order, const PilotOrder& pilot) {
    const auto& study = study_.settings();
    auto& profile = order.profile;
    const bool massager = study.modality == Modality::Massager;
    request_.procedure = procedureOf(profile, study, askedProcedure(order, study.procedure));
    if (!massager) fitProfile(profile, study);

    settings_.code = who_.code;
    settings_.runSha256 = runHash(study, request_.procedure);
    const auto& continued = unfinished_.continued();
    settings_.session = continued ? continued->number : who_.sessions + 1;
    if (const auto& seed = unfinished_.earlier().seed) order.seed = *seed;  // the session's seed replaces the command's
    settings_.seed = order.seed;
    settings_.painCeiling = study.painCeiling.value_or(kPainCeiling);
    settings_.holds = openHolds(study_, who_);
    auto turn = encodingTurn(study_, who_, continued);
    settings_.encoding = std::move(turn.encoding);
    settings_.earlierEncoding = std::move(turn.earlier);
    settings_.answers = answersOf(study_, who_);
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
    order.virtualParticipant = who_.isVirtual();
    order.rehearsal = study_.isRehearsal();
    if (order.uris.empty()) order.uris.push_back({"sim", "", {}});
    if (massager)
        order.ownNeeds = {Role::Massager};
    else
        std::ranges::for_each(order.uris, fitSource);
    order.makeSession = [this, profile, limits = order.limits](const SessionAbout& about, const Clock& clock,
                                                               const DeviceSet& devices) -> Result<RunSession> {
        if (auto holds = machineGate(study_.settings(), profile, limits, devices, utcToday()); !holds)
            return failure(holds);
        if (auto same = unfinished_.sameDevice(devices); !same) return failure(same);
        if (auto same = unfinished_.sameProcedure(settings_.runSha256); !same) return failure(same);
        return makeSession(about, clock, devices);
    };

    request_.code = who_.code;
    request_.script = {order.script.name, order.script.sha256};
    request_.encoding = settings_.encoding;
    request_.codeConfirmed = pilot.codeConfirmed || who_.isVirtual();
    request_.personAnswers = pilot.people != nullptr;
    request_.exclusions = pilot.exclusions;
    if (!who_.isVirtual()) return;
    if (auto answers = virtualAnswers(order.settings.parameters, study)) request_.exclusions = std::move(*answers);
}

/// Without a language, the words are those of the session that goes on, else the approval's first, else English.
Result<void> PilotRun::chooseWords(std::string language, const std::filesystem::path& folder) {
    const auto& study = study_.settings();
    if (language.empty()) language = unfinished_.earlier().language;
    if (language.empty()) language = study.words.empty() ? ParticipantWords::english().code() : study.words[0].code;
    auto words = languageOf(folder, language);
    if (!words) return failure(words);
    if (auto same = unfinished_.sameWords(*words); !same) return same;
    if (auto stated = wordsGate(study, *words); !stated) return stated;
    settings_.words = std::move(*words);
    return {};
}

Result<RunSession> PilotRun::makeSession(const SessionAbout& about, const Clock& clock, const DeviceSet& devices) {
    const auto identities = devices.identities();
    request_.devicesSimulated = std::ranges::all_of(identities, &DeviceIdentity::simulated);
    if (!request_.devicesSimulated && std::ranges::any_of(identities, &DeviceIdentity::simulated))
        return fail(kGateRefused,
                    "some of the devices are simulated and others are not; a session takes simulated devices or real "
                    "ones");
    auto begun = unfinished_.begin(study_, request_, remarks_);
    if (!begun) return failure(begun);
    begun_ = std::move(*begun);
    settings_.basis = begun_->session.basis;
    auto writer = SessionWriter::create(begun_->path, about, clock, begun_->seal);
    if (!writer) return failure(writer);
    auto noted =
        (*writer)->event(clock.now(), kLedgerEvent, {{"row", begun_->ledgerRow}, {"head", begun_->ledgerHead}});
    if (!noted) return failure(noted);
    RunSession made;
    made.files.session = begun_->path;
    made.writer = std::move(*writer);
    made.seal = begun_->seal;
    return made;
}

namespace {

/// Judges a virtual participant's checklist, which has the study's own questions too.
Result<void> virtualChecklist(const RunOrder& order, const std::filesystem::path& folder) {
    StudySettings settings;
    if (Study::isThere(folder)) {
        const auto study = Study::open(folder, nullptr, Study::Access::Read);
        if (!study) return failure(study);
        settings = study->settings();
    }
    const auto answers = virtualAnswers(order.settings.parameters, settings);
    if (!answers) return failure(answers);
    const bool isVirtual = textOf(order, "participant").starts_with(kVirtualPrefix);  // or known later, by a code
    return isVirtual ? exclusionGate(*answers, settings) : Result<void>();
}

}  // namespace

Result<std::unique_ptr<PilotRun>> PilotRun::prepare(RunOrder order, PilotOrder pilot, Registry& registry,
                                                    std::shared_ptr<BenchTap> tap) {
    std::shared_ptr<MarkerServer> markers;
    if (pilot.markers) {
        auto listens = MarkerServer::listen(*pilot.markers);
        if (!listens) return failure(listens);
        markers = std::move(*listens);
    }
    if (pilot.people != nullptr && pilot.pace > 0)
        order.pace = pilot.pace;
    else
        order.realtime = order.realtime || pilot.people != nullptr;
    if (auto lsl = prepareLsl(order, registry); !lsl) return failure(lsl);
    if (auto held = virtualChecklist(order, pilot.study); !held) return failure(held);  // before a rehearsal is made
    auto study = openStudyFor(order, pilot);
    if (!study) return failure(study);
    std::unique_ptr<PilotRun> made(new PilotRun(std::move(*study), std::move(markers)));
    SessionRequest answered;  // saved before a later step can refuse
    answered.code = made->who_.code;
    answered.exclusions = pilot.exclusions;
    if (auto noted = made->study_.noteExclusions(answered); !noted) return failure(noted);
    auto unfinished = UnfinishedSession::choose(
        made->study_, made->who_, {textOf(order, "unfinished"), order.script.name, pilot.people != nullptr});
    if (!unfinished) return failure(unfinished);
    made->unfinished_ = std::move(*unfinished);
    if (auto may = made->study_.mayTakePart(made->who_, made->unfinished_.continued().has_value()); !may)
        return failure(may);
    made->fitOrder(order, pilot);
    if (auto chosen = made->chooseWords(textOf(order, kLanguage), pilot.study); !chosen) return failure(chosen);
    const VirtualObserver* truth = nullptr;
    PilotParticipant* people = pilot.people;
    if (made->who_.isVirtual()) {
        auto observer = virtualObserver(order.settings.parameters, made->study_.settings(), *made->who_.virtualSeed,
                                        made->settings_.unit);
        if (!observer) return failure(observer);
        order.ownLoad = observer->settings().who.skin.text();
        std::vector<std::string> names;
        for (const auto& each : made->settings_.conditions) names.push_back(each.name);
        made->virtual_ = std::make_unique<VirtualPilotParticipant>(*observer, std::move(names));
        if (people == nullptr) {
            truth = &made->virtual_->observer();
            people = made->virtual_.get();
        }
    }
    auto run = ProtocolRun::prepare(std::move(order), registry, std::move(tap));
    if (!run) {
        made->cancelBooked();
        return failure(run);
    }
    made->run_ = std::move(*run);
    const auto& opened = made->run_->opened();
    made->record_ = std::make_unique<PilotRecord>(*opened.session, *opened.clock, made->unfinished_.earlier().events);
    if (made->markers_) made->markers_->begin(opened.clock);
    if (made->markers_ || opened.lsl) {
        made->record_->onMarker = [tcp = made->markers_, lsl = opened.lsl](const PilotMarker& each) {
            if (tcp) tcp->send(each.at, each.name);
            if (lsl) lsl->marker(each.at, each.name);
        };
    }
    if (pilot.watch != nullptr && people == made->virtual_.get()) {
        made->virtual_->onShow = watching(*pilot.watch, pilot.pace, opened.clock);
        made->virtual_->onCounted = [watch = pilot.watch](const PilotCounts& counts) { watch->counted(counts); };
    }
    const auto parts = static_cast<int>(made->begun_->session.parts.size());
    made->session_ =
        std::make_unique<PilotSession>(made->run_->bench(), *people, *made->record_, made->settings_, truth, parts);
    if (made->virtual_ && truth == nullptr)
        made->session_->stage().likelyAnswer = [virtualOne = made->virtual_.get()](const auto& felt,
                                                                                   const auto& prompt) {
            return likelyAnswerOf(*virtualOne, felt, prompt);
        };
    if (const auto& continued = made->unfinished_.continued())
        made->session_->resumesFrom(continued->parts.back().file, made->unfinished_.earlier().chainHead);
    auto* raw = made.get();
    made->session_->mayGoOn = [raw] { return raw->mayGoOn(); };
    made->session_->care().skinReacted = [raw](const std::string& moment, int score) {
        return raw->noteSkin(moment, score);
    };
    return made;
}

/// Cancels a new session whose bench could not be opened, because it could not be resumed. Keeps a resumed session.
void PilotRun::cancelBooked() {
    if (!begun_ || unfinished_.continued()) return;
    static_cast<void>(study_.cancelSession(begun_->session.id));
}

/// Checks that the study is still approved and that the session is within its time limit, from its first part on.
Result<void> PilotRun::mayGoOn() const {
    if (auto approved = study_.stillApproved(); !approved) return approved;
    const double most_min = study_.settings().sessionMax_min;
    const double taken_min =
        std::chrono::duration<double, std::ratio<60>>(SystemTime::real().wall() - begun_->session.parts.front().begun)
            .count();
    if (taken_min < most_min) return {};
    return fail(kGateRefused,
                "the session has taken {:.0f} min; the study allows {:.0f} min, so no further block begins", taken_min,
                most_min);
}

/// Writes an adverse event into the ledger, which remains after a withdrawal. Until the investigator states severity
/// and cause, the worst is assumed.
Result<void> PilotRun::noteSkin(const std::string& moment, int score) {
    AdverseEvent event;
    event.what = fmt::format(
        "skin at the {} scored {} of 4 ({}); severity and relation as noted by the program, for "
        "the investigator to judge",
        settings_.modality(), score, moment);
    event.severity = severityOfSkin(score);
    event.relation = 5;
    const auto& session = begun_->session.id;
    const auto noted = study_.adverseEvents();
    if (!noted) return failure(noted);
    const bool known = std::ranges::any_of(*noted, [&](const auto& each) {
        return each.first == session && each.second.what == event.what;  // noted before the interruption
    });
    return known ? Result<void>() : study_.adverseEvent(session, event);
}

Result<void> PilotRun::start(RunRequest hooks) {
    hooks.pilot = session_.get();
    return run_->start(std::move(hooks));
}

/// Call this once no more rows with a marker are written.
std::optional<MarkerTally> PilotRun::endMarkers() {
    if (!markers_) return std::nullopt;
    if (run_->script() != nullptr) static_cast<void>(run_->script()->wait());
    const auto tally = markers_->end();
    const auto& opened = run_->opened();  // an error in writing this row is found when the session is closed
    static_cast<void>(opened.session->event(opened.clock->now(), "markers", toJson(tally)));
    return tally;
}

RunResult PilotRun::finish() {
    session_->stage().participant().leave();  // so that the participant's STOP never uses a bench that is gone
    const auto markers = endMarkers();
    auto result = run_->finish();
    result.markers = markers;
    const auto ended = session_->stage().ended();
    if (ended == PilotEnd::Unfinished) return result;
    std::string head;
    if (const auto reader = SessionReader::open(begun_->path, begun_->seal)) head = reader->chainHead();
    const auto state = ended == PilotEnd::Complete ? StudySessionState::Complete : StudySessionState::Stopped;
    if (auto noted = study_.endSession(begun_->session.id, state, head); !noted) {
        result.troubles.push_back(noted.error());
        result.weighTroubles();
    }
    return result;
}

}  // namespace tacto
