// Tests closing the window: the output goes off first, then comes the question; no text is lost without asking.
#include <QCheckBox>
#include <QLineEdit>
#include <QMessageBox>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>

#include "app/gui/runner/ScriptEditor.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "tests/gui/Looks.h"
#include "tests/gui/window/WindowFixture.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class Closing : public Window {
protected:
    Closing() { std::filesystem::remove_all(userProtocolsFolder()); }
    ~Closing() override { window.closeUnasked(); }
    [[nodiscard]] QMessageBox* asked() {
        for (auto* box : window.findChildren<QMessageBox*>("closeQuestion")) {
            if (box->isVisible()) return box;
        }
        return nullptr;
    }
    void answer(QMessageBox::StandardButton button) {
        ASSERT_NE(asked(), nullptr);
        click(*asked()->button(button));
        QCoreApplication::processEvents();
    }
    /// Types unsaved text into the script of a new protocol.
    gui::ScriptEditor* writeScript() {
        visit(6);
        QPushButton* button = nullptr;
        EXPECT_IN_TIME(comesTrue([&] { return (button = find<QPushButton>(window, "New…")) != nullptr; }));
        click(*button);
        gui::ScriptEditor* editor = nullptr;
        EXPECT_IN_TIME(comesTrue([&] {
            for (auto* one : window.findChildren<gui::ScriptEditor*>()) {
                if (one->isVisible()) editor = one;
            }
            return editor != nullptr;
        }));
        QTest::keyClicks(&editor->code(), "// mine");  // Space is text here, and stops nothing
        return editor;
    }
    /// Starts a run that delivers until it is stopped.
    void runSlowly() {
        visit(3);
        QPushButton* run = nullptr;
        ASSERT_IN_TIME(comesTrue([&] {
            run = find<QPushButton>(window, "runButton");
            return run != nullptr && run->isEnabled();
        }));
        click(*find<QAbstractButton>(window, "Wiring"));
        find<QCheckBox>(window, "realtime")->setChecked(true);
        click(*run);
        ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Delivering; }, 30'000));
    }
};

TEST_F(Closing, DuringARunTheOutputIsOffBeforeTheQuestion) {
    RecordProperty("hazard", "H2");
    runSlowly();
    window.close();
    EXPECT_TRUE(window.isVisible());
    EXPECT_NE(state(), InterlockState::Delivering);
    EXPECT_NE(state(), InterlockState::Armed);
    ASSERT_NE(asked(), nullptr);
    EXPECT_THAT(asked()->text().toStdString(), HasSubstr("The output was switched off. The run was stopped"));
    EXPECT_EQ(asked()->windowModality(), Qt::NonModal) << "STOP stays within reach";
    shot(*asked(), "close-run");
    EXPECT_EQ(faultsOf(*asked()), "");
    answer(QMessageBox::Cancel);
    EXPECT_TRUE(window.isVisible());
    EXPECT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Closed; }));
    EXPECT_EQ(asked(), nullptr);
    window.close();
    EXPECT_FALSE(window.isVisible()) << "there is nothing left to ask about";
}

TEST_F(Closing, DuringARunTheAnswerCloses) {
    runSlowly();
    window.close();
    answer(QMessageBox::Close);
    EXPECT_FALSE(window.isVisible());
}

TEST_F(Closing, AnAnswerIsForTheRunThatItWasAskedAbout) {
    RecordProperty("hazard", "H2");
    runSlowly();
    window.close();
    ASSERT_NE(asked(), nullptr);
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Closed; }));
    window.openSimulatedBench();
    EXPECT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Live; }));
    EXPECT_EQ(asked(), nullptr) << "with another bench the question is void";
    EXPECT_TRUE(window.isVisible());
}

TEST_F(Closing, UnsavedScriptsAreAskedAboutWithTheOutputOff) {
    RecordProperty("hazard", "H2");
    open();
    arm();
    deliver();
    auto* editor = writeScript();
    ASSERT_IN_TIME(state() == InterlockState::Delivering);
    window.close();
    EXPECT_NE(state(), InterlockState::Delivering);
    EXPECT_NE(state(), InterlockState::Armed);
    ASSERT_NE(asked(), nullptr);
    EXPECT_THAT(asked()->text().toStdString(), HasSubstr("Not saved: the protocol script new"));
    shot(*asked(), "close-scripts");
    EXPECT_EQ(faultsOf(*asked()), "");
    answer(QMessageBox::Cancel);
    EXPECT_TRUE(window.isVisible());
    EXPECT_THAT(editor->code().text().toStdString(), HasSubstr("// mine"));
    window.close();
    answer(QMessageBox::Discard);
    EXPECT_FALSE(window.isVisible());
    EXPECT_FALSE(std::filesystem::exists(userProtocolsFolder()));
}

TEST_F(Closing, SavesAndThenCloses) {
    auto* editor = writeScript();
    window.close();
    answer(QMessageBox::Save);
    EXPECT_TRUE(window.isVisible()) << "it has no name yet";
    auto* name = editor->findChild<QLineEdit*>("protocolName");
    ASSERT_TRUE(name->isVisible());
    name->selectAll();
    QTest::keyClicks(name, "bend");
    QTest::keyClick(name, Qt::Key_Return);
    EXPECT_TRUE(std::filesystem::exists(userProtocolsFolder() / "bend.js"));
    EXPECT_IN_TIME(comesTrue([this] { return !window.isVisible(); }));
}

TEST_F(Closing, WhoGoesBackToTheTextKeepsTheWindow) {
    auto* editor = writeScript();
    window.close();
    answer(QMessageBox::Save);
    click(*find<QPushButton>(*editor, "Do not save"));
    // Saving later only saves and does not close the window.
    QTest::keyClick(&editor->code(), Qt::Key_S, Qt::ControlModifier);
    QTest::keyClick(editor->findChild<QLineEdit*>("protocolName"), Qt::Key_Return);
    EXPECT_TRUE(std::filesystem::exists(userProtocolsFolder() / "my-protocol.js"));
    letLive(100);
    EXPECT_TRUE(window.isVisible());
    EXPECT_TRUE(editor->isVisible());
}

TEST_F(Closing, WhatCannotBeSavedKeepsTheWindow) {
    auto* editor = writeScript();
    std::filesystem::create_directories(userProtocolsFolder().parent_path());
    std::ofstream(userProtocolsFolder()) << "a file where the folder belongs";
    window.close();
    answer(QMessageBox::Save);
    QTest::keyClick(editor->findChild<QLineEdit*>("protocolName"), Qt::Key_Return);
    letLive(100);
    EXPECT_TRUE(window.isVisible());
    EXPECT_THAT(editor->findChild<QLabel*>("scriptMessage")->text().toStdString(), HasSubstr("Not saved"));
    EXPECT_THAT(editor->code().text().toStdString(), HasSubstr("// mine"));
}

TEST_F(Closing, EscThatStopsTheOutputLeavesTheSearchOfTheScriptOpen) {
    RecordProperty("hazard", "H2");
    open();
    arm();
    deliver();
    auto* editor = writeScript();
    ASSERT_IN_TIME(comesTrue([&] { return editor->isActiveWindow(); }));
    QTest::keyClick(&editor->code(), Qt::Key_F, Qt::ControlModifier);
    auto* words = editor->findChild<QLineEdit*>("findWords");
    ASSERT_TRUE(words->isVisible());
    ASSERT_IN_TIME(state() == InterlockState::Delivering);
    QTest::keyClick(words, Qt::Key_Escape);
    EXPECT_IN_TIME(comesTrue([this] { return state() == InterlockState::Disarmed; }));
    EXPECT_TRUE(words->isVisible());
    letLive(300);  // time for the editor to see the state of the output
    QTest::keyClick(words, Qt::Key_Escape);
    EXPECT_FALSE(words->isVisible()) << "there was nothing to stop";
    EXPECT_TRUE(editor->isVisible());
}

TEST_F(Closing, NothingIsAskedWhereNothingIsLost) {
    open();
    arm();
    deliver();
    window.close();
    EXPECT_FALSE(window.isVisible());
    EXPECT_EQ(asked(), nullptr);
}

}  // namespace
}  // namespace tacto::test
