#include "app/gui/controller/BenchController.h"

#include <QMetaObject>
#include <cmath>

#include "app/gui/controller/OpenBench.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "core/bench/arming/CommandPreview.h"

namespace tacto::gui {

// Interval between checks for connected devices; plugging in takes longer than milliseconds.
constexpr std::chrono::milliseconds kWatchInterval(1000);

BenchController::BenchController(MakeRegistry makeRegistry, QObject* parent, std::function<QDate()> today)
    : QObject(parent),
      makeRegistry_(std::move(makeRegistry)),
      watch_(makeRegistry_, kWatchInterval),
      day_(nullptr, std::move(today)),
      thread_([this] { return serveLive(); }, [this] { closeOnThread(); }) {
    qRegisterMetaType<std::shared_ptr<const Capture>>();
    qRegisterMetaType<std::shared_ptr<const FinishedRun>>();
    qRegisterMetaType<OperatorQuestion>();
    if (auto profile = shippedProfile()) profile_ = std::move(*profile);
    if (auto limits = shippedLimits()) limits_ = std::move(*limits);
}

BenchController::~BenchController() {
    stop("the window closes");
    thread_.quit();
}

std::string BenchController::confirmationOf(const Load& load) const {
    if (!open_ || !open_->output) return {};
    return armingText(*open_->output, open_->source ? &*open_->source : nullptr, profile_, OutputMode::BenchLoad, load);
}

Result<bool> BenchController::allVirtual(const std::vector<DeviceUri>& uris) const {
    return makeRegistry_().allVirtual(uris);
}

void BenchController::stop(const char* by) noexcept {
    stops_->raise();  // first, even if there is nothing to switch off: see StopCounter.h
    published_.stop(by);
}

bool BenchController::markMoment(Instant at, const QString& word) {
    if (!published_.markMoment(at, word.toStdString())) return false;
    emit marked(toSeconds(at), word);
    return true;
}

void BenchController::openLive(const LiveOrder& order) {
    if (day_.asksFirst()) return;
    profile_ = order.profile;
    speed_ = order.speed;
    closedByRun_.reset();
    lastLive_ = order;
    auto noted = order;
    noted.notes = day_.notes();
    thread_.post([this, noted = std::move(noted), asked = stops_->mark()] { openOnThread(noted, asked); });
}

void BenchController::openAgain() {
    if (!closedByRun_ || activity_ != Activity::Closed) return;
    auto order = *closedByRun_;
    order.profile = profile_;
    order.speed = speed_;
    openLive(order);
}

void BenchController::close() {
    closedByRun_.reset();
    stop("closed by the operator");
    thread_.post([this] { closeOnThread(); });
}

void BenchController::arm(const ArmRequest& request, StopMark asked) {
    order(asked, [this, request](Bench& bench) -> Result<void> {
        if (bench.telemetry().paused) bench.disarm();  // so that resuming releases no train
        bench.resume();                                // ends a pause that began before this arming
        const auto armed = bench.arm(request);
        if (!armed) {
            bench.disarm();                                    // also ends an earlier arming
            static_cast<void>(bench.drive(DriveSource::Off));  // what was to drive then waits for no later arming
        }
        if (auto again = live_->repeatCapture(); !again) scopeFailed(again.error());  // arming may use the scope
        if (!armed) return armed;
        tell([this] { emit this->armed(); });
        return {};
    });
}

void BenchController::checkImpedance(const ArmRequest& request, StopMark asked) {
    order(asked, [this, request](Bench& bench) -> Result<void> {
        if (bench.telemetry().paused) bench.disarm();
        bench.resume();  // ends a pause that began before this check
        const auto found = bench.checkImpedance(request);
        if (auto again = live_->repeatCapture(); !again) scopeFailed(again.error());  // checking may use the scope
        if (!found) return failure(found);
        tell([this, ohms = *found ? (*found)->value() : std::nan("")] { emit checked(ohms); });
        return {};
    });
}

void BenchController::disarm() { stop("operator (Disarm)"); }

void BenchController::resetFault(std::optional<std::uint64_t> known) {
    order([known](Bench& bench) { return bench.resetFault(known); });
}

void BenchController::drive(DriveSource source, double roughness, double pressure) {
    lastDrive_ = {source, roughness, pressure};
    if (source == DriveSource::Off) {
        thread_.post([this] {
            if (live_) static_cast<void>(live_->bench().drive(DriveSource::Off));  // if refused, nothing drives anyway
        });
        return;
    }
    order([source, roughness, pressure](Bench& bench) { return bench.drive(source, roughness, pressure); });
}

void BenchController::setProfile(const Profile& profile) {
    if (activity_ == Activity::Closed) {
        profile_ = profile;
        emit changed();
        return;
    }
    if (activity_ != Activity::Live) {
        return report({ErrorCode::NotArmed,
                       "The profile was not changed: it can be while no protocol runs and no bench opens or closes."});
    }
    thread_.post([this, profile] {
        if (!live_) return;
        if (auto set = live_->bench().setProfile(profile); !set) return report(set.error());
        tell([this, profile] {
            profile_ = profile;
            emit changed();
        });
    });
}

void BenchController::setSpeed(double speed) {
    if (speed > 0) speed_ = speed;
}

void BenchController::present(const std::string& material, double speed_mm_s, double force_n) {
    thread_.post([this, material, speed_mm_s, force_n] {
        if (!live_ || !live_->bench().devices().surface) return;
        auto& surface = *live_->bench().devices().surface;
        if (auto done = surface.present(material, MillimetresPerSecond(speed_mm_s), Newtons(force_n)); !done)
            return report(done.error());
        tell([this, name = QString::fromStdString(material), speed_mm_s, force_n] {
            emit presented(name, speed_mm_s, force_n);
        });
    });
}

void BenchController::fitLoad(const std::string& load) {
    thread_.post([this, load] {
        if (!live_ || !live_->bench().devices().load) return;
        live_->bench().disarm();
        if (auto done = live_->bench().devices().load->fitLoad(load); !done) return report(done.error());
        // A capture of the previous load is neither shown nor waited for.
        if (auto again = live_->repeatCapture(); !again) return scopeFailed(again.error());
        tell([this, name = QString::fromStdString(load)] { emit loadFitted(name); });
    });
}

void BenchController::runScope(const ScopeSettings& settings, bool single, std::optional<Seconds> untriggeredAfter) {
    thread_.post([this, settings, single, untriggeredAfter] {
        if (!live_) return;
        if (auto asked = live_->runScope(settings, single, untriggeredAfter); !asked) scopeFailed(asked.error());
    });
}

void BenchController::stopScope() {
    thread_.post([this] {
        if (live_) live_->stopScope();
    });
}

/// Hands the order to the bench's thread. From now on no other run can begin.
RunOrder BenchController::begun(const RunOrder& order, StopMark asked) {
    if (activity_ == Activity::Live) closedByRun_ = lastLive_;
    profile_ = order.profile;
    operator_.prepare(order.settings.answers);
    auto marked = order;
    marked.stops = stops_;
    marked.asked = asked;
    marked.watched = [beat = heartbeat_] { return beat->runs(); };
    activity_ = Activity::Opening;
    emit changed();
    return marked;
}

/// A prepared run: how to start and end it, and what it owns meanwhile.
struct BenchController::Prepared {
    std::shared_ptr<void> owner;
    ProtocolRun* run = nullptr;
    std::function<Result<void>(RunRequest hooks)> start;
    std::function<RunResult()> finish;
};

std::uint64_t BenchController::run(const RunOrder& order, StopMark asked) {
    const auto number = ++lastRun_;
    thread_.post([this, number, marked = begun(order, asked)] {
        runOnThread(marked, number, [&](auto& registry, auto tap, auto& found) -> Result<Prepared> {
            auto made = ProtocolRun::prepare(marked, registry, std::move(tap), &found);
            if (!made) return failure(made);
            const std::shared_ptr<ProtocolRun> run(std::move(*made));
            return Prepared{run, run.get(), [run](RunRequest hooks) { return run->start(std::move(hooks)); },
                            [run] { return run->finish(); }};
        });
    });
    return number;
}

std::uint64_t BenchController::runPilot(const RunOrder& order, const PilotSeats& seats, StopMark asked) {
    const auto number = ++lastRun_;
    thread_.post([this, number, seats, marked = begun(order, asked)] {
        runOnThread(marked, number, [&](auto& registry, auto tap, auto&) -> Result<Prepared> {
            PilotOrder pilot;
            pilot.study = seats.study;
            if (seats.passphrase) {
                auto words = Passphrase::from(*seats.passphrase);
                if (!words) return failure(words);
                pilot.passphrase.emplace(std::move(*words));
            }
            pilot.people = seats.people;
            pilot.codeConfirmed = seats.codeConfirmed;
            pilot.exclusions = seats.exclusions;
            pilot.markers = seats.markers;
            pilot.watch = seats.watch;
            pilot.pace = seats.pace;
            auto made = PilotRun::prepare(marked, std::move(pilot), registry, std::move(tap));
            if (!made) return failure(made);
            const std::shared_ptr<PilotRun> run(std::move(*made));
            if (seats.begun) {
                const auto& record = run->session().stage().record();
                seats.begun(run->run().opened().clock, static_cast<int>(record.count(row::kParticipantStop)));
            }
            published_.setTakesStop(seats.takesStop);
            return Prepared{run, &run->run(), [run](RunRequest hooks) { return run->start(std::move(hooks)); },
                            [run] { return run->finish(); }};
        });
    });
    return number;
}

void BenchController::order(StopMark asked, std::function<Result<void>(Bench&)> task) {
    thread_.post([this, asked, task = std::move(task)] {
        if (!live_) return report(Error{ErrorCode::NotArmed, "Nothing was done: no bench is open."});
        auto& bench = live_->bench();
        auto done = bench.begin(asked);
        if (done)
            done = task(bench);
        else  // nothing that was ordered together with this drives later
            static_cast<void>(bench.drive(DriveSource::Off));
        if (!done) report(done.error());
    });
}

void BenchController::tell(std::function<void()> onWindow) {
    QMetaObject::invokeMethod(this, std::move(onWindow), Qt::QueuedConnection);
}

void BenchController::report(const Error& error) {
    tell([this, what = QString::fromStdString(error.message)] { emit failed(what); });
}

bool BenchController::serveLive() {
    if (!live_) return false;
    live_->serve(speed_);
    serveScope();
    if (const auto failed = live_->takeRecordingFailure()) {
        live_->bench().stop("recording failed");
        report(Error{failed->code, fmt::format("Recording ended: {}. Output is off.", failed->message)});
    }
    return true;
}

void BenchController::serveScope() {
    const auto taken = live_->takeCapture();
    if (!taken) return scopeFailed(taken.error());
    if (!*taken) return;
    tell([this, capture = *taken] { emit captured(capture); });
    if (auto again = live_->repeatCapture(); !again) scopeFailed(again.error());
}

void BenchController::scopeFailed(const Error& error) {
    report(error);
    tell([this, why = QString::fromStdString(error.message)] { emit scopeStopped(why); });
}

void BenchController::become(Activity activity, std::shared_ptr<const OpenBench> open, std::shared_ptr<BenchTap> tap,
                             const std::optional<Error>& why) {
    tell([this, activity, open = std::move(open), tap = std::move(tap), why] {
        if (why) emit failed(QString::fromStdString(why->message));
        activity_ = activity;
        open_ = open;
        tap_ = tap;
        emit changed();
    });
}

void BenchController::openOnThread(const LiveOrder& order, StopMark asked) {
    closeOnThread();
    become(Activity::Opening, nullptr, nullptr);
    const auto give_up = [this](const Error& error) { become(Activity::Closed, nullptr, nullptr, error); };
    auto registry = makeRegistry_();
    auto live =
        DrivenBench::open(registry, order, {limits_, stops_, asked, [beat = heartbeat_] { return beat->runs(); }});
    if (!live) return give_up(live.error());
    published_.publish(&(*live)->bench());  // from here on a stop reaches this bench
    if (stops_->movedSince(asked)) {
        published_.publish(nullptr);
        live->reset();
        return give_up(Error{ErrorCode::Stopped, "stopped while devices were opening: nothing was delivered"});
    }
    live_ = std::move(*live);
    become(Activity::Live, live_->about(), live_->tap());
    for (const auto& warning : live_->warnings()) report({ErrorCode::Unsupported, warning});
}

void BenchController::closeOnThread() {
    if (!live_) return;
    published_.publish(nullptr);
    if (auto closed = live_->close(); !closed) report(closed.error());
    live_.reset();
    become(Activity::Closed, nullptr, nullptr);
}

void BenchController::runOnThread(const RunOrder& order, std::uint64_t number, const Prepare& prepare) {
    closeOnThread();
    become(Activity::Opening, nullptr, nullptr);
    static_cast<void>(feed_.take());
    auto finished = std::make_shared<FinishedRun>();
    finished->number = number;
    finished->order = order;
    auto tap = std::make_shared<BenchTap>();
    auto registry = makeRegistry_();
    const auto end = [&] {
        published_.setTakesStop(nullptr);
        tell([this, finished] {
            activity_ = Activity::Closed;
            open_.reset();
            tap_.reset();
            emit changed();
            emit this->finished(finished);
        });
    };
    std::optional<LeftFault> found;
    auto prepared = prepare(registry, tap, found);
    if (!prepared) {
        finished->result.outcome.error = prepared.error();
        finished->result.stoppedBySafety = prepared.error().code == ErrorCode::Stopped;
        finished->result.leftIn = std::move(found);
        return end();
    }
    auto& run = *prepared->run;
    published_.publish(&run.bench());                // from here on a stop reaches this bench
    published_.forgetStops();                        // the order is newer than these; start() checks them
    const auto bench = describeBench(run.opened());  // asks the devices now, before the script uses them
    RunRequest hooks;
    hooks.operatorDesk = &operator_;
    feed_.listen(hooks);
    if (auto started = prepared->start(std::move(hooks)); !started) {
        published_.publish(nullptr);
        finished->result = prepared->finish();
        *prepared = {};
        return end();
    }
    // A stop between start and publishing has switched off the bench but has not reached the script, so we pass it on.
    // A stop that the script asked for itself, such as the stop test of a pilot session, ends nothing.
    if (const auto by = published_.publish(run.bench(), *run.script())) run.script()->stop(by->c_str());
    become(Activity::Running, bench, tap);
    const auto clock = run.opened().clock;
    const auto began = clock->now();
    static_cast<void>(run.script()->wait());
    if (bench->paced) finished->benchTime = Seconds(clock->now() - began);
    published_.publish(nullptr);
    become(Activity::Closing, nullptr, tap);
    finished->result = prepared->finish();
    finished->html = run.files().report(".html");
    finished->pdf = run.files().report(".pdf");
    *prepared = {};  // released before the end is signalled, so that a study held by the run can be opened then
    end();
}

RunOrder BenchController::orderOf(ProtocolSource script, ProtocolDeclaration declaration,
                                  ProtocolSettings settings) const {
    RunOrder order;
    order.script = std::move(script);
    order.declaration = std::move(declaration);
    order.settings = std::move(settings);
    order.notes = day_.notes();
    order.profile = profile_;
    order.limits = limits_;
    return order;
}

}  // namespace tacto::gui

#include "moc_BenchController.cpp"
