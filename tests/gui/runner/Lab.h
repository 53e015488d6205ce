// Lab.h - a laboratory for tests: a folder for protocols of its own, a controller on the simulated bench, a workspace
// that is refreshed as the window does it.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QTest>
#include <QTimer>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "app/gui/runner/ProtocolWorkspace.h"
#include "app/gui/runner/ScriptEditor.h"
#include "app/gui/runner/StepButton.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"

namespace tacto::test {

class Lab : public testing::Test {
protected:
    Lab() {
        std::filesystem::remove_all(userProtocolsFolder());
        QObject::connect(&controller, &gui::BenchController::finished,
                         [this](std::shared_ptr<const gui::FinishedRun> run) { ended = std::move(run); });
        QObject::connect(&frame, &QTimer::timeout, [this] {
            if (workspace) workspace->refresh();
        });
        frame.start(33);
    }

    /// A protocol of the lab's own.
    static void write(const std::string& name, const std::string& script) {
        std::filesystem::create_directories(userProtocolsFolder());
        std::ofstream(userProtocolsFolder() / (name + ".js")) << script;
    }

    /// Shows the workspace; waits until it can run.
    void open(const QString& protocol, QSize size = {1300, 820}) {
        workspace = std::make_unique<gui::ProtocolWorkspace>(controller, protocol);
        workspace->resize(size);
        workspace->show();
        ASSERT_IN_TIME(comesTrue([this] { return find<QPushButton>(*workspace, "runButton") != nullptr; }));
    }
    template <class T>
    T& the(const QString& name) {
        T* found = nullptr;
        if (!comesTrue([&] { return (found = find<T>(*workspace, name)) != nullptr; }))
            throw std::runtime_error("nothing visible is called " + name.toStdString());
        return *found;
    }
    bool ready() {
        return comesTrue([this] { return the<QPushButton>("runButton").isEnabled(); });
    }
    /// Chooses a protocol in the workspace of all of them.
    void choose(const QString& protocol) {
        auto& chooser = the<QComboBox>("chooser");
        const int index = chooser.findData(protocol);
        ASSERT_GE(index, 0) << protocol.toStdString();
        chooser.setCurrentIndex(index);
    }
    /// Types into a field, on the page of whichever step has it.
    void type(const QString& field, const QString& text) {
        const auto seen = [&] { return find<QLineEdit>(*workspace, field) != nullptr; };
        constexpr int kLaidOut_ms = 100, kRounds = 25;
        for (int round = 0; round < kRounds && !seen(); ++round) {  // the form is there once the script has been read
            for (const auto step : {gui::kSettings, gui::kReference, gui::kWiring, gui::kSign}) {
                if (comesTrue(seen, kLaidOut_ms)) break;
                workspace->goTo(step);
            }
        }
        auto& line = the<QLineEdit>(field);
        line.setFocus();
        line.selectAll();
        QTest::keyClicks(&line, text);
    }
    bool ends(int limit_ms = 60'000) {
        return comesTrue([this] { return ended != nullptr; }, limit_ms) &&
               comesTrue([this] { return !says("verdict").isEmpty(); });
    }
    gui::ScriptEditor* editor() { return find<gui::ScriptEditor>(*workspace, "scriptEditor"); }
    /// A step of the path, as it stands there.
    gui::StepButton& step(const QString& name) { return the<gui::StepButton>(name); }
    /// Filled buttons that are in sight.
    std::vector<QString> primaries() {
        std::vector<QString> found;
        for (const auto* button : workspace->findChildren<QPushButton*>()) {
            if (button->isVisible() && button->property("role") == "primary")
                found.push_back(QString(button->text()).remove('&'));
        }
        return found;
    }
    QString says(const QString& name) {
        const auto* label = find<QLabel>(*workspace, name);
        return label != nullptr ? label->text() : QString();
    }

    gui::BenchController controller{simulatedRegistry};
    std::unique_ptr<gui::ProtocolWorkspace> workspace;
    std::shared_ptr<const gui::FinishedRun> ended;
    QTimer frame;
};

}  // namespace tacto::test
