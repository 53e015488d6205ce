// Lab.h - a laboratory for tests: a folder for its own protocols, a controller on the simulated bench, and a workspace
// that is refreshed as in the window.
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

    /// Writes a protocol of the laboratory's own.
    static void write(const std::string& name, const std::string& script) {
        std::filesystem::create_directories(userProtocolsFolder());
        std::ofstream(userProtocolsFolder() / (name + ".js")) << script;
    }

    /// Shows the workspace, and waits until it can run.
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
    /// Chooses a protocol in the workspace for all protocols.
    void choose(const QString& protocol) {
        auto& chooser = the<QComboBox>("chooser");
        const int index = chooser.findData(protocol);
        ASSERT_GE(index, 0) << protocol.toStdString();
        chooser.setCurrentIndex(index);
    }
    /// Types into a field, on the page of the step that has it.
    void type(const QString& field, const QString& text) {
        const auto seen = [&] { return find<QLineEdit>(*workspace, field) != nullptr; };
        constexpr int kLaidOut_ms = 100, kRounds = 25;
        for (int round = 0; round < kRounds && !seen(); ++round) {  // the form appears after the script was read
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
    /// A step in the path.
    gui::StepButton& step(const QString& name) { return the<gui::StepButton>(name); }
    /// The names of the visible filled buttons.
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
