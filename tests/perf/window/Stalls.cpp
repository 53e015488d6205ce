// Stalls.cpp - how long the window cannot answer while long work runs: a protocol, its report, an export.
//
// Measures the longest gap between beats of a 5 ms timer in the window's event loop, compared with an idle window.
// Goal: at most ten times as long. People notice gaps from 50 ms on.
#include <QLabel>
#include <QPdfDocument>
#include <QProcess>
#include <QPushButton>
#include <QTabWidget>
#include <QTemporaryDir>
#include <fmt/format.h>

#include "app/gui/runner/ProtocolWorkspace.h"
#include "app/gui/sessions/SessionsWorkspace.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/window/MainWindow.h"
#include "tests/gui/Person.h"
#include "tests/gui/window/StallWatch.h"
#include "tests/perf/Verdict.h"
#include "tests/perf/window/WindowPerf.h"

namespace tacto::perf {

namespace {

using test::Stalls;
using test::stallsWhile;

constexpr int kLive = 0, kSeparability = 3, kSessions = 5;  // indices of workspaces, from the top
constexpr int kExported_s = 600;                            // seconds of simulated bench
constexpr int kLimit_ms = 120'000;

class Table {
public:
    void add(const std::string& what, const std::optional<Stalls>& stalls) {
        if (!stalls) return notMeasured(what, "it did not come to its end");
        const bool first = std::exchange(idle_ms_, idle_ms_ > 0 ? idle_ms_ : stalls->longest_ms) == 0;
        auto remark = first ? std::string("baseline")
                            : verdict(stalls->longest_ms / idle_ms_, "the idle window", kMaxTimes) +
                                  ofLimit(stalls->longest_ms, Stalls::kNoticed_ms, "ms that a person feels");
        if (stalls->noticed > 1) remark += fmt::format(" ({} such)", stalls->noticed);
        line(what, fmt::format("{:7.1f} ms {:6.1f} s", stalls->longest_ms, stalls->lasted_s), remark);
    }

private:
    static constexpr double kMaxTimes = 10;
    double idle_ms_ = 0;
};

std::function<bool()> after(int ms) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(ms);
    return [until] { return std::chrono::steady_clock::now() >= until; };
}

/// Records a session of ten minutes through the command line.
QString longSession(const std::string& cli, const QString& folder) {
    QProcess recorder;
    recorder.start(QString::fromStdString(cli), {"run", "live", "--device", "sim:", "--set",
                                                 QString("duration=%1").arg(kExported_s), "--out", folder});
    if (!recorder.waitForFinished(kLimit_ms) || recorder.exitCode() != 0) return {};
    const auto found = QDir(folder).entryInfoList({"*.tacto"}, QDir::Files);
    return found.isEmpty() ? QString() : found.first().absoluteFilePath();
}

void protocolAndReport(gui::MainWindow& window, Table& table) {
    std::shared_ptr<const gui::FinishedRun> ended;
    QObject::connect(&window.controller(), &gui::BenchController::finished, &window,
                     [&](std::shared_ptr<const gui::FinishedRun> run) { ended = std::move(run); });
    window.showWorkspace(kSeparability);
    auto* run = test::find<QPushButton>(window, "runButton");
    if (run == nullptr || !comes([&] { return run->isEnabled(); }))
        return notMeasured("separability", "there is nothing to run");
    table.add("separability, 25 repeats",
              stallsWhile([&] { test::click(*run); }, [&] { return ended != nullptr; }, kLimit_ms));
    if (!ended) return;
    table.add(
        "its report, drawn by a child process",
        stallsWhile([] {}, [&] { return std::filesystem::exists(ended->html) && std::filesystem::exists(ended->pdf); },
                    kLimit_ms));
    auto* open = test::find<QPushButton>(window, "Sign report…");
    if (open == nullptr || !comes([&] { return open->isEnabled(); })) return notMeasured("the report", "not written");
    table.add("the report, opened in place", stallsWhile([&] { test::click(*open); }, after(2500), kLimit_ms));
}

void sessionAndExport(gui::MainWindow& window, const std::string& cli, Table& table) {
    const QTemporaryDir folder;
    const auto session = longSession(cli, folder.path() + "/long");
    if (session.isEmpty()) return notMeasured("export", cli + " records no session");
    window.showWorkspace(kSessions);
    auto* workspace = window.findChild<gui::SessionsWorkspace*>();
    auto* verify = test::find<QPushButton>(*workspace, "Verify");
    auto* says = workspace->findChild<QLabel*>("sessionsSay");
    const auto size = fmt::format("a session of {} min", kExported_s / 60);
    table.add(size + ", opened",
              stallsWhile([&] { window.openFile(session); },
                          [&, settled = after(3000)] { return settled() && verify->isEnabled(); }, kLimit_ms));
    table.add(size + ", exported as CSV",
              stallsWhile([&] { workspace->exportTo(folder.path() + "/csv"); },
                          [&] { return says->text().startsWith("Exported to"); }, kLimit_ms));
    table.add(size + ", verified", stallsWhile([&] { test::click(*verify); },
                                               [&] { return says->text().contains("is intact"); }, kLimit_ms));
}

}  // namespace

void measureStalls(const std::string& cli) {
    heading("event-loop stalls", "  longest   lasted");
    Table table;
    gui::MainWindow window(test::simulatedRegistry);
    window.resize(1440, 900);
    window.show();
    pass(500);
    table.add("the window, nothing runs", stallsWhile([] {}, after(3000), kLimit_ms));
    protocolAndReport(window, table);
    sessionAndExport(window, cli, table);
    window.showWorkspace(kLive);
    table.add("the simulated bench, opened and armed", stallsWhile(
                                                           [&] {
                                                               gui::LiveOrder order;
                                                               order.uris.push_back(*DeviceUri::parse("sim:"));
                                                               order.profile = window.controller().profile();
                                                               window.controller().openLive(order);
                                                               ArmRequest request;
                                                               request.operatorConfirmed = true;
                                                               window.controller().arm(request);
                                                               window.controller().present("P120", 50, 1);
                                                               window.controller().drive(DriveSource::Sensor);
                                                           },
                                                           after(4000), kLimit_ms));
    auto* tabs = window.findChild<gui::TabbedPage*>("livePage");
    table.add("the same, in the oscilloscope", stallsWhile([&] { tabs->setCurrentIndex(1); }, after(4000), kLimit_ms));
    window.close();
}

}  // namespace tacto::perf
