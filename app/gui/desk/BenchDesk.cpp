#include "app/gui/desk/BenchDesk.h"

#include <QMetaObject>
#include <chrono>
#include <cmath>

#include "app/report/Report.h"
#include "app/run/KnownCalibration.h"
#include "app/run/OpenDevices.h"
#include "app/run/ScopeStatement.h"
#include "app/scripting/ProtocolLibrary.h"
#include "core/bench/ArmingText.h"
#include "core/bench/ProfileReach.h"
#include "core/safety/UnitFolders.h"

namespace tacto::gui {

namespace {

using SteadyTime = std::chrono::steady_clock::time_point;

constexpr std::size_t kFeedCaptures = 8;
constexpr Seconds kLongestTurn{0.25};  // of bench time at once: stop and commands come between two

SteadyTime realNow() { return std::chrono::steady_clock::now(); }

}  // namespace

/// A bench that is open for looking and driving by hand. The desk's thread only.
struct BenchDesk::Live {
    std::shared_ptr<Clock> clock;
    std::shared_ptr<BenchTap> tap = std::make_shared<BenchTap>();
    std::unique_ptr<SessionWriter> session;
    std::unique_ptr<Bench> bench;
    bool paced = false;
    SteadyTime servedAt = realNow();
    std::optional<ScopeSettings> scope;  // captures are wanted
    bool single = false;
    std::optional<Seconds> untriggeredAfter;
    bool recordingFailed = false;
};

// A socket is looked at that often; plugging in is not a thing of milliseconds.
constexpr std::chrono::milliseconds kLookEvery(1000);

BenchDesk::BenchDesk(MakeRegistry makeRegistry, QObject* parent)
    : QObject(parent), makeRegistry_(std::move(makeRegistry)), watch_(makeRegistry_, kLookEvery), thread_() {
    qRegisterMetaType<std::shared_ptr<const Capture>>();
    qRegisterMetaType<std::shared_ptr<const FinishedRun>>();
    qRegisterMetaType<OperatorQuestion>();
    if (auto profile = shippedProfile()) profile_ = std::move(*profile);
    if (auto limits = shippedLimits()) limits_ = std::move(*limits);
    thread_ = std::thread([this] { work(); });
}

BenchDesk::~BenchDesk() {
    stop("the window closes");
    {
        const std::scoped_lock lock(taskMutex_);
        quitting_ = true;
    }
    taskCame_.notify_all();
    thread_.join();
}

Telemetry BenchDesk::telemetry() const {
    const std::scoped_lock lock(benchMutex_);
    return bench_ != nullptr ? bench_->telemetry() : Telemetry{};
}

std::string BenchDesk::confirmationOf(const Load& load) const {
    if (!open_ || !open_->output) return {};
    return armingText(*open_->output, open_->source ? &*open_->source : nullptr, profile_, OutputMode::BenchLoad, load);
}

std::optional<DeviceReport> BenchDesk::deviceReport(Role role) const {
    const std::scoped_lock lock(benchMutex_);
    return bench_ != nullptr ? bench_->deviceReport(role) : std::nullopt;
}

Result<bool> BenchDesk::allVirtual(const std::vector<DeviceUri>& uris) const {
    return makeRegistry_().allVirtual(uris);
}

void BenchDesk::stop(const char* by) noexcept {
    stops_->raise();  // first, and whatever there is to switch off: see StopCounter.h
    const std::scoped_lock lock(benchMutex_);
    stoppedBy_ = by;
    if (script_ != nullptr)
        script_->stop(by);
    else if (bench_ != nullptr)
        bench_->stop(by);
}

void BenchDesk::pause() {
    const std::scoped_lock lock(benchMutex_);
    if (script_ != nullptr)
        script_->pause();
    else if (bench_ != nullptr)
        bench_->pause();
}

void BenchDesk::resume() {
    const std::scoped_lock lock(benchMutex_);
    if (script_ != nullptr)
        script_->resume();
    else if (bench_ != nullptr)
        bench_->resume();
}

void BenchDesk::openLive(const LiveOrder& order) {
    profile_ = order.profile;
    speed_ = order.speed;
    post([this, order, asked = stops_->mark()] { openOnThread(order, asked); });
}

void BenchDesk::close() {
    stop("closed by the operator");
    post([this] { closeOnThread(); });
}

void BenchDesk::arm(const ArmRequest& request, StopMark asked) {
    order(asked, [this, request](Bench& bench) -> Result<void> {
        if (bench.telemetry().paused) bench.disarm();  // so that resuming lets no train out
        bench.resume();                                // a pause from before this arming is over
        const auto armed = bench.arm(request);
        if (!armed) bench.disarm();          // also what was armed before
        if (live_->scope) requestCapture();  // arming may have used the oscilloscope
        if (!armed) return armed;
        tell([this] { emit this->armed(); });
        return {};
    });
}

void BenchDesk::checkImpedance(const ArmRequest& request, StopMark asked) {
    order(asked, [this, request](Bench& bench) -> Result<void> {
        if (bench.telemetry().paused) bench.disarm();
        bench.resume();  // a pause from before this check is over
        const auto found = bench.checkImpedance(request);
        if (live_->scope) requestCapture();  // the check may have used the oscilloscope
        if (!found) return failure(found);
        tell([this, ohms = *found ? (*found)->value() : std::nan("")] { emit checked(ohms); });
        return {};
    });
}

void BenchDesk::disarm() { stop("operator (Disarm)"); }

void BenchDesk::resetFault() {
    order([](Bench& bench) { return bench.resetFault(); });
}

void BenchDesk::drive(DriveSource source, double roughness, double pressure) {
    if (source == DriveSource::Off) {
        post([this] {
            if (live_) static_cast<void>(live_->bench->drive(DriveSource::Off));  // refused for nothing
        });
        return;
    }
    order([source, roughness, pressure](Bench& bench) { return bench.drive(source, roughness, pressure); });
}

void BenchDesk::setProfile(const Profile& profile) {
    if (activity_ == Activity::Closed) {
        profile_ = profile;
        emit changed();
        return;
    }
    if (activity_ != Activity::Live) {
        return report({ErrorCode::NotArmed,
                       "The profile was not changed: it can be while no protocol runs and no bench opens or closes."});
    }
    post([this, profile] {
        if (!live_) return;
        if (auto set = live_->bench->setProfile(profile); !set) return report(set.error());
        tell([this, profile] {
            profile_ = profile;
            emit changed();
        });
    });
}

void BenchDesk::setSpeed(double speed) {
    if (speed > 0) speed_ = speed;
}

void BenchDesk::present(const std::string& material, double speed_mm_s, double force_n) {
    post([this, material, speed_mm_s, force_n] {
        if (!live_ || !live_->bench->devices().surface) return;
        auto& surface = *live_->bench->devices().surface;
        if (auto done = surface.present(material, MillimetresPerSecond(speed_mm_s), Newtons(force_n)); !done)
            return report(done.error());
        tell([this, name = QString::fromStdString(material), speed_mm_s, force_n] {
            emit presented(name, speed_mm_s, force_n);
        });
    });
}

void BenchDesk::fitLoad(const std::string& load) {
    post([this, load] {
        if (!live_ || !live_->bench->devices().load) return;
        live_->bench->disarm();
        if (auto done = live_->bench->devices().load->fitLoad(load); !done) report(done.error());
    });
}

void BenchDesk::runScope(const ScopeSettings& settings, bool single, std::optional<Seconds> untriggeredAfter) {
    post([this, settings, single, untriggeredAfter] {
        if (!live_) return;
        live_->scope = settings;
        live_->single = single;
        live_->untriggeredAfter = untriggeredAfter;
        requestCapture();
    });
}

void BenchDesk::stopScope() {
    post([this] {
        if (!live_) return;
        live_->scope.reset();
        live_->bench->cancelCaptures();
    });
}

void BenchDesk::run(const RunOrder& order, StopMark asked) {
    profile_ = order.profile;
    operator_.prepare(order.settings.answers);
    auto marked = order;
    marked.stops = stops_;
    marked.asked = asked;
    marked.watched = [pulse = pulse_] { return pulse->runs(); };
    activity_ = Activity::Opening;  // at once: no other run is begun beside it
    emit changed();
    post([this, marked = std::move(marked)] { runOnThread(marked); });
}

RunFeed BenchDesk::takeRunFeed() {
    const std::scoped_lock lock(feedMutex_);
    return std::exchange(feed_, {});
}

void BenchDesk::post(std::function<void()> task) {
    {
        const std::scoped_lock lock(taskMutex_);
        tasks_.push_back(std::move(task));
    }
    taskCame_.notify_all();
}

void BenchDesk::order(StopMark asked, std::function<Result<void>(Bench&)> task) {
    post([this, asked, task = std::move(task)] {
        if (!live_) return report(Error{ErrorCode::NotArmed, "Nothing was done: no bench is open."});
        auto done = live_->bench->begin(asked);
        if (done) done = task(*live_->bench);
        if (!done) report(done.error());
    });
}

void BenchDesk::tell(std::function<void()> onWindow) {
    QMetaObject::invokeMethod(this, std::move(onWindow), Qt::QueuedConnection);
}

void BenchDesk::report(const Error& error) {
    tell([this, what = QString::fromStdString(error.message)] { emit failed(what); });
}

void BenchDesk::work() {
    constexpr auto kTurn = std::chrono::milliseconds(4);
    for (;;) {
        std::function<void()> task;
        {
            std::unique_lock lock(taskMutex_);
            const auto wanted = [this] { return quitting_ || !tasks_.empty(); };
            if (live_)
                taskCame_.wait_for(lock, kTurn, wanted);
            else
                taskCame_.wait(lock, wanted);
            if (quitting_) break;
            if (!tasks_.empty()) {
                task = std::move(tasks_.front());
                tasks_.pop_front();
            }
        }
        if (task) task();
        serveLive();
    }
    closeOnThread();
}

void BenchDesk::serveLive() {
    if (!live_) return;
    live_->bench->attend();
    if (live_->paced) {
        const auto now = realNow();
        const Seconds passed(std::chrono::duration<double>(now - live_->servedAt).count() * speed_);
        live_->servedAt = now;
        live_->bench->idle(std::min(passed, kLongestTurn));
    }
    serveScope();
    if (const auto failed = live_->session->failed(); failed && !std::exchange(live_->recordingFailed, true)) {
        live_->bench->stop("recording failed");
        report(Error{failed->code, fmt::format("Recording ended: {}. Output is off.", failed->message)});
    }
}

void BenchDesk::requestCapture() {
    const auto requested = live_->bench->requestCaptures(1, *live_->scope, live_->untriggeredAfter);
    if (!requested) endScope(requested.error());
}

void BenchDesk::endScope(const Error& error) {
    live_->scope.reset();
    report(error);
    tell([this, why = QString::fromStdString(error.message)] { emit scopeStopped(why); });
}

void BenchDesk::serveScope() {
    if (!live_->scope) return;
    auto taken = live_->bench->takeCaptures();
    if (!taken) return endScope(taken.error());
    if (taken->empty()) return;
    auto capture = std::make_shared<const Capture>(std::move(taken->back()));
    tell([this, capture] { emit captured(capture); });
    if (live_->single)
        live_->scope.reset();
    else
        requestCapture();
}

void BenchDesk::publishBench(Bench* bench, ScriptRun* script) {
    const std::scoped_lock lock(benchMutex_);
    bench_ = bench;
    script_ = script;
}

std::string BenchDesk::lastStop() const {
    const std::scoped_lock lock(benchMutex_);
    return stoppedBy_;
}

void BenchDesk::become(Activity activity, std::shared_ptr<const OpenBench> open, std::shared_ptr<BenchTap> tap) {
    tell([this, activity, open = std::move(open), tap = std::move(tap)] {
        activity_ = activity;
        open_ = open;
        tap_ = tap;
        emit changed();
    });
}

namespace {

std::shared_ptr<const OpenBench> describe(Bench& bench, const SessionAbout& about,
                                          const std::filesystem::path& session) {
    auto open = std::make_shared<OpenBench>();
    open->about = about;
    open->session = session;
    auto& devices = bench.devices();
    if (devices.sensor) open->streams.assign(devices.sensor->streams().begin(), devices.sensor->streams().end());
    if (devices.stimulator) open->source = devices.stimulator->traits();
    if (devices.stimulator)
        open->output = devices.stimulator->identity();
    else if (devices.massager)
        open->output = devices.massager->identity();
    if (devices.oscilloscope) open->scope = devices.oscilloscope->traits();
    open->paced = bench.clock().isVirtual();
    open->surfaces = devices.surface != nullptr;
    open->untriggered = bench.canCaptureUntriggered();
    return open;
}

}  // namespace

void BenchDesk::openOnThread(const LiveOrder& order, StopMark asked) {
    closeOnThread();
    become(Activity::Opening, nullptr, nullptr);
    const auto give_up = [this](const Error& error) {
        report(error);
        become(Activity::Closed, nullptr, nullptr);
    };
    auto registry = makeRegistry_();
    const auto allVirtual = registry.allVirtual(order.uris);
    if (!allVirtual) return give_up(allVirtual.error());
    auto live = std::make_unique<Live>();
    live->paced = *allVirtual;
    if (live->paced)
        live->clock = std::make_shared<VirtualClock>();
    else
        live->clock = std::make_shared<SteadyClock>();
    const OpenContext context{
        .clock = *live->clock, .seed = order.seed, .declaredLoad = kDefaultLoad, .stops = stops_.get(), .asked = asked};
    auto devices = openDevices(registry, order.uris, order.needed, context);
    if (!devices) return give_up(devices.error());
    const auto certificate = stateOscilloscope(*devices);
    auto about = aboutSession(*devices, order.profile, limits_, nullptr);
    about.seed = order.seed;
    auto session = makeRunSession("", "live", about, *live->clock);
    if (!session) return give_up(session.error());
    live->session = std::move(session->writer);
    if (const auto kept = keepCertificate(certificate, *live->session, live->clock->now()); !kept)
        return give_up(kept.error());
    BenchConfig config;
    config.devices = std::move(*devices);
    config.clock = live->clock;
    config.profile = order.profile;
    config.limits = limits_.sets;
    config.session = live->session.get();
    config.tap = live->tap.get();
    config.stops = stops_;
    config.asked = asked;
    config.watched = [pulse = pulse_] { return pulse->runs(); };
    applyKnown(knownCalibration(config.devices), config);
    config.units = unitFolders();
    auto bench = Bench::create(std::move(config));
    if (!bench) return give_up(bench.error());
    live->bench = std::move(*bench);
    live->servedAt = realNow();
    publishBench(live->bench.get(), nullptr);  // from here on a stop reaches it
    if (stops_->movedSince(asked)) {
        publishBench(nullptr, nullptr);
        live->bench.reset();
        return give_up(Error{ErrorCode::Stopped, "stopped while devices were opening: nothing was delivered"});
    }
    auto open = describe(*live->bench, about, session->files.session);
    auto tap = live->tap;
    live_ = std::move(live);
    become(Activity::Live, std::move(open), std::move(tap));
    if (const auto& stimulator = live_->bench->devices().stimulator) {
        const auto beyond = beyondReach(order.profile, stimulator->traits(), stimulator->identity().name);
        if (beyond) report({ErrorCode::LimitExceeded, *beyond});
    }
    if (const auto& sensor = live_->bench->devices().sensor) {
        const auto another = madeWithAnother(order.profile, sensor->identity().serial);
        if (another) report({ErrorCode::Unsupported, *another});
    }
    if (!certificate.text.empty() && !certificate.used) report({ErrorCode::Unsupported, certificate.text});
}

void BenchDesk::closeOnThread() {
    if (!live_) return;
    publishBench(nullptr, nullptr);
    live_->bench.reset();
    if (auto closed = live_->session->close(); !closed) report(closed.error());
    live_.reset();
    become(Activity::Closed, nullptr, nullptr);
}

void BenchDesk::runOnThread(const RunOrder& order) {
    closeOnThread();
    become(Activity::Opening, nullptr, nullptr);
    static_cast<void>(takeRunFeed());
    auto finished = std::make_shared<FinishedRun>();
    finished->order = order;
    auto tap = std::make_shared<BenchTap>();
    auto registry = makeRegistry_();
    const auto end = [&] {
        become(Activity::Closed, nullptr, nullptr);
        tell([this, finished] { emit this->finished(finished); });
    };
    auto prepared = ProtocolRun::prepare(order, registry, tap.get());
    if (!prepared) {
        finished->result.outcome.error = prepared.error();
        finished->result.stoppedBySafety = prepared.error().code == ErrorCode::Stopped;
        return end();
    }
    auto& run = **prepared;
    publishBench(&run.bench(), nullptr);  // from here on a stop reaches it
    RunRequest hooks;
    hooks.operatorDesk = &operator_;
    hooks.onProgress = [this](const ScriptProgress& progress) {
        const std::scoped_lock lock(feedMutex_);
        feed_.progress = progress;
    };
    hooks.onLog = [this](const std::string& text) {
        const std::scoped_lock lock(feedMutex_);
        feed_.log.push_back(text);
    };
    hooks.onTrial = [this](const nlohmann::json& trial) {
        const std::scoped_lock lock(feedMutex_);
        feed_.trials.push_back(trial);
    };
    hooks.onCapture = [this](const Capture& capture) {
        auto shared = std::make_shared<const Capture>(capture);
        const std::scoped_lock lock(feedMutex_);
        if (feed_.captures.size() == kFeedCaptures) feed_.captures.erase(feed_.captures.begin());
        feed_.captures.push_back(std::move(shared));
    };
    if (auto started = run.start(std::move(hooks)); !started) {
        publishBench(nullptr, nullptr);
        finished->result = run.finish();
        return end();
    }
    publishBench(&run.bench(), run.script());
    // A stop between start and publishing has switched off the bench, and has not reached the script.
    if (stops_->movedSince(order.asked)) run.script()->stop(lastStop().c_str());
    become(Activity::Running, describe(run.bench(), run.about(), run.files().session), tap);
    static_cast<void>(run.script()->wait());
    publishBench(nullptr, nullptr);
    become(Activity::Closing, nullptr, tap);
    finished->result = run.finish();
    // An abandoned script's bench may still push into it.
    if (finished->result.outcome.abandoned) static_cast<void>(new std::shared_ptr<BenchTap>(tap));
    finished->html = run.files().report(".html");
    finished->pdf = run.files().report(".pdf");
    end();
}

}  // namespace tacto::gui
