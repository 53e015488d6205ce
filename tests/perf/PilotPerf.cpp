// Pilot sessions: a whole session of 90 trials with thresholds for a virtual participant; the time from an answer until
// the next trial's first row is on disk; the time from the participant's Esc to the end of the device's forceOff()
// during trains. BM_SessionAcknowledgedEvent, twice, gives the cost of two rows alone; tests/perf/window gives the cost
// of a press in an empty window.
//
// The goals are 8 s per session, 20 ms to the next trial (median), and 10 ms to output off (worst).
#include <QApplication>
#include <QEventLoop>
#include <QKeyEvent>
#include <QWindow>
#include <algorithm>
#include <atomic>
#include <benchmark/benchmark.h>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <thread>
#include <unistd.h>

#include "app/gui/pilot/ParticipantWindow.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/window/StopKeys.h"
#include "app/run/PilotRun.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "core/base/Random.h"
#include "core/study/StudyKeys.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "tests/perf/Windows.h"
#include "tests/support/WrappedTwin.h"

namespace tacto {
namespace {

namespace fs = std::filesystem;
using SteadyMoment = std::chrono::steady_clock::time_point;

/// A folder for sessions, apart from the user's data.
class Place {
public:
    Place() {
        fs::create_directories(path);
        ::setenv("XDG_DATA_HOME", (path / "data").c_str(), 1);
    }
    ~Place() { fs::remove_all(path); }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;
    const fs::path path = fs::temp_directory_path() / ("tactoscope-perf-pilot-" + std::to_string(::getpid()));
};

double ms(std::chrono::steady_clock::duration time) { return std::chrono::duration<double, std::milli>(time).count(); }

void report(benchmark::State& state, std::vector<double> all_ms) {
    if (all_ms.empty()) return state.SkipWithError("nothing was measured");
    std::ranges::sort(all_ms);
    state.counters["n"] = static_cast<double>(all_ms.size());
    state.counters["median_ms"] = all_ms[all_ms.size() / 2];
    state.counters["p95_ms"] = all_ms[all_ms.size() * 95 / 100];
    state.counters["worst_ms"] = all_ms.back();
}

/// Measures from the command to the result: study, script, sealed rows.
void BM_PilotSession(benchmark::State& state) {
    needWindows();
    const Place place;
    int number = 0;
    double trials = 0;
    for (auto _ : state) {
        std::vector<std::unique_ptr<Driver>> drivers;
        drivers.push_back(makeSimulatedDriver());
        Registry registry(std::move(drivers));
        RunOrder order;
        order.script = ProtocolLibrary().find("pilot-identification").value();
        order.declaration = readDeclaration(order.script).value();
        order.settings = applySettings(order.declaration, {{"participant", "virtual:7"}}).value();
        order.needed = order.declaration.needs;
        order.limits = shippedLimits().value();
        order.profile = shippedProfile().value();
        PilotOrder pilot;
        pilot.study = place.path / ("study " + std::to_string(++number));
        auto run = PilotRun::prepare(std::move(order), std::move(pilot), registry);
        if (!run) return state.SkipWithError(run.error().message.c_str());
        if (auto started = (*run)->start({}); !started) return state.SkipWithError(started.error().message.c_str());
        const auto result = (*run)->finish();
        if (result.outcome.error) return state.SkipWithError(result.outcome.error->message.c_str());
        const auto& found = result.outcome.results;
        trials = found["n"].get<double>() + found["catch"]["n"].get<double>();
    }
    state.counters["trials"] = trials;
}
BENCHMARK(BM_PilotSession)->Name("pilot/a session of 90 trials")->Unit(benchmark::kMillisecond)->UseRealTime();

/// A bench for a person, with a simulated current source.
struct PersonBench {
    PersonBench(const Place& place, std::shared_ptr<Clock> time, const std::string& load,
                std::function<std::unique_ptr<Stimulator>(std::unique_ptr<Stimulator>)> as = {})
        : clock(std::move(time)) {
        const auto file = place.path / ("session " + std::to_string(++made));
        writer = SessionWriter::create(file, {}, *clock,
                                       std::make_shared<SessionSeal>("study", "session", Secret::random(32)))
                     .value();
        std::vector<std::unique_ptr<Driver>> drivers;
        drivers.push_back(makeSimulatedDriver());
        Registry registry(std::move(drivers));
        const std::vector<DeviceUri> uris{DeviceUri::parse("sim:stimulator?mode=current&step=0.5mA").value()};
        BenchConfig config;
        config.devices = registry.open(uris, {Role::Stimulator}, OpenContext{*clock, 1, load}).value();
        if (as) config.devices.stimulator = as(std::move(config.devices.stimulator));
        config.clock = clock;
        config.profile.electrodeArea = SquareCentimetres(4);
        config.limits = shippedLimits().value().sets;
        config.session = writer.get();
        config.person = PersonSetup{.participant = "P-7K3D",
                                    .consentRecorded = true,
                                    .discomfortLimit = Milliamps(30),
                                    .rampStep = Milliamps(1),
                                    .cap = Milliamps(15)};
        config.mode = OutputMode::Person;
        config.virtualParticipant = true;
        bench = Bench::create(std::move(config)).value();
        record = std::make_unique<PilotRecord>(*writer, *clock, std::vector<SessionRow>());
        settings.code = "P-7K3D";
        settings.basis = SessionBasis::Virtual;
    }
    ~PersonBench() {
        record.reset();
        bench.reset();
    }
    PersonBench(const PersonBench&) = delete;
    PersonBench& operator=(const PersonBench&) = delete;

    static inline int made = 0;
    std::shared_ptr<Clock> clock;
    std::unique_ptr<SessionWriter> writer;
    std::unique_ptr<Bench> bench;
    std::unique_ptr<PilotRecord> record;
    PilotSettings settings;
};

/// A virtual participant that records when it identified the condition.
class TimedPeople final : public PilotParticipant {
public:
    explicit TimedPeople(PilotParticipant& people) : people_(people) {}
    void show(const PilotScreen& screen) override { people_.show(screen); }
    [[nodiscard]] Result<PilotAnswer> ask(const PilotPrompt& prompt) override {
        people_.stop = stop;
        auto said = people_.ask(prompt);
        if (prompt.kind == PromptKind::Condition) saidAt = std::chrono::steady_clock::now();
        return said;
    }
    void delivered(const FeltPresentation& felt) override { people_.delivered(felt); }
    [[nodiscard]] std::vector<EarlyPress> takeEarly() override { return people_.takeEarly(); }
    void cancel() noexcept override { people_.cancel(); }
    [[nodiscard]] bool holding() const noexcept override { return people_.holding(); }
    [[nodiscard]] std::optional<Hindrance> hindrance() const override { return people_.hindrance(); }
    [[nodiscard]] bool hasScreen() const noexcept override { return people_.hasScreen(); }
    [[nodiscard]] bool answersInRealTime() const noexcept override { return people_.answersInRealTime(); }
    std::optional<SteadyMoment> saidAt;

private:
    PilotParticipant& people_;
};

Result<void> answersAll(PilotSession& session) {
    if (auto done = session.begin(true); !done) return done;
    if (auto done = session.thresholds().ascendingLimits(); !done) return done;
    if (auto done = session.thresholds().detection(DetectionMethod::Quest); !done) return done;
    if (auto done = session.thresholds().range(); !done) return done;
    if (auto done = session.identification().familiarise(); !done) return done;
    if (auto done = session.identification().train(); !done) return done;
    for (int block = 1; block <= session.stage().settings().blocks; ++block) {
        if (auto done = session.identification().testBlock(block); !done) return done;
    }
    return {};
}

/// Measures from the answer to the row `trial-begin` of the next trial; the row `answer` comes between, and both are
/// durable. Meanwhile the bench lets the response time pass in virtual time.
void BM_PilotNextTrial(benchmark::State& state) {
    needWindows();
    const Place place;
    std::vector<double> all_ms;
    for (auto _ : state) {
        VirtualObserverSettings who;
        who.who = drawParticipant({}, 7, 0, Micros(200), SquareCentimetres(4));
        auto observer = VirtualObserver::create(who).value();
        PersonBench behind(place, std::make_shared<VirtualClock>(), who.who.skin.text());
        std::vector<std::string> names;
        for (const auto& each : behind.settings.conditions) names.push_back(each.name);
        VirtualPilotParticipant participant(std::move(observer), names);
        TimedPeople people(participant);
        PilotSession session(*behind.bench, people, *behind.record, behind.settings, &participant.observer(), 1);
        std::size_t begun = 0;
        behind.record->onWritten = [&](std::size_t) {
            const auto now = std::chrono::steady_clock::now();
            const auto count = behind.record->count(row::kTrialBegin);
            if (count > begun && people.saidAt) {
                all_ms.push_back(ms(now - *people.saidAt));
                people.saidAt.reset();
            }
            begun = count;
        };
        if (auto done = answersAll(session); !done) return state.SkipWithError(done.error().message.c_str());
    }
    report(state, std::move(all_ms));
}
BENCHMARK(BM_PilotNextTrial)
    ->Name("pilot/answer to next trial's first row")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(3);

/// Time of the first forceOff() since this was cleared.
std::atomic<std::int64_t> pilotOffAt_ns{0};

std::int64_t steady_ns() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

class ClockedStimulator final : public test::WrappedStimulator {
public:
    using WrappedStimulator::WrappedStimulator;
    void forceOff() noexcept override {
        WrappedStimulator::forceOff();
        std::int64_t none = 0;  // only the first call is stored
        pilotOffAt_ns.compare_exchange_strong(none, steady_ns());
    }
};

/// In real time: the key arrives from outside at a random moment, while trains are delivered.
void BM_PilotStopKey(benchmark::State& state) {
    needWindows();
    const Place place;
    const auto clock = std::make_shared<SteadyClock>();
    PersonBench behind(place, clock, "200 ohm + (3 kohm || 20 nF)", [](std::unique_ptr<Stimulator> inner) {
        return std::make_unique<ClockedStimulator>(std::move(inner));
    });
    gui::ParticipantDesk desk;
    desk.begin(clock);
    gui::ParticipantWindow window(desk, [&](const char* by) { static_cast<void>(desk.stopBy(by)); });
    gui::StopKeys keys(
        [&](const char* by) {
            static_cast<void>(desk.stopBy(by));
            window.noteStop();
        },
        nullptr);
    window.resize(1440, 900);
    window.show();
    window.activateWindow();
    PilotStage stage(*behind.bench, desk, *behind.record, behind.settings);
    Random random(7, "pilot stop");
    std::vector<double> all_ms;
    for (auto _ : state) {
        QEventLoop loop;
        std::string trouble;
        std::int64_t postedAt_ns = 0;
        std::vector<std::unique_ptr<QEvent>> escape;
        for (const auto type : {QEvent::KeyPress, QEvent::KeyRelease})
            escape.push_back(std::make_unique<QKeyEvent>(type, Qt::Key_Escape, Qt::NoModifier));
        std::thread session([&] {
            if (auto armed = stage.arm(); !armed) trouble = armed.error().message;
            PilotScreen screen;
            screen.state = ScreenState::Feel;
            screen.phase = "test";
            desk.show(screen);
            const auto before = behind.bench->telemetry().trainsDelivered;
            std::thread hand([&] {
                const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(5);
                while (behind.bench->telemetry().trainsDelivered == before && std::chrono::steady_clock::now() < limit)
                    std::this_thread::sleep_for(std::chrono::milliseconds(1));
                std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(40 * random.uniform()));
                pilotOffAt_ns = 0;
                postedAt_ns = steady_ns();
                for (auto& event : escape) QCoreApplication::postEvent(window.windowHandle(), event.release());
            });
            const auto presented = behind.bench->present(testPresentation(Milliamps(0.5), Seconds(0.1), Seconds(4)));
            hand.join();
            if (trouble.empty() && (!presented || presented->end != PresentationEnd::Stopped))
                trouble = presented ? presented->reason : presented.error().message;
            QMetaObject::invokeMethod(&loop, &QEventLoop::quit, Qt::QueuedConnection);
        });
        loop.exec();
        session.join();
        if (!trouble.empty() || pilotOffAt_ns == 0) return state.SkipWithError(("not stopped: " + trouble).c_str());
        all_ms.push_back(1e-6 * static_cast<double>(pilotOffAt_ns - postedAt_ns));
        state.SetIterationTime(1e-3 * all_ms.back());
        static_cast<void>(stage.takeStop());
        stage.rest();
        if (auto begun = behind.bench->begin(behind.bench->stops().mark()); !begun)
            return state.SkipWithError(begun.error().message.c_str());
    }
    desk.leave();
    report(state, std::move(all_ms));
}
BENCHMARK(BM_PilotStopKey)
    ->Name("pilot/Esc to the output's end")
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime()
    ->Iterations(100);

}  // namespace
}  // namespace tacto
