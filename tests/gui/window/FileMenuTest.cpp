// Tests the File menu: recent files are those that open, and each entry does what it does on every desktop.
#include <QFile>
#include <QFileDialog>
#include <QMenu>
#include <QMenuBar>
#include <QSettings>
#include <QStatusBar>
#include <QTemporaryDir>
#include <QToolButton>
#include <fstream>
#include <random>

#include "app/gui/window/Workspaces.h"
#include "tests/gui/OwnDataHome.h"
#include "tests/gui/sessions/WrittenSessions.h"
#include "tests/gui/window/WindowFixture.h"
#include "tests/support/InTime.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

class FileMenu : private OwnDataHome, public Window {
protected:
    ~FileMenu() override { QSettings().clear(); }
    [[nodiscard]] QMenu& menu() { return *window.menuBar()->actions().front()->menu(); }
    [[nodiscard]] QAction* entry(const QString& text) {
        for (auto* action : menu().actions())
            if (action->text().remove('&') == text) return action;
        return nullptr;
    }
    [[nodiscard]] QStringList recent() {
        emit entry("Recent")->menu()->aboutToShow();
        QStringList all;
        for (auto* action : entry("Recent")->menu()->actions()) all << action->text();
        return all;
    }
    [[nodiscard]] QString write(const char* name, const std::string& text) const {
        const auto path = folder.filePath(name);
        std::ofstream(path.toStdString()) << text;
        return path;
    }
    [[nodiscard]] QString message() {
        const auto* line = window.statusBar()->findChild<QToolButton*>();
        return line == nullptr ? QString() : line->toolTip().section('\n', 0, 0);
    }
    [[nodiscard]] static std::string samples() {
        std::string text = "time_s,voltage_v\n";
        for (int i = 0; i < 400; ++i) text += fmt::format("{:.7f},{}\n", i * 1e-6, i % 50 < 10 ? 5 : 0);
        return text;
    }
    QTemporaryDir folder;
};

TEST_F(FileMenu, RecentFilesAreThoseThatOpenedNewestFirst) {
    const WrittenSessions sessions;
    const auto example = [](const char* name) {
        return QString::fromStdString((sourceDir() / "resources" / "examples" / name).string());
    };
    const QStringList good{write("a.csv", samples()), write("b.csv", samples()), example("linen-slide"),
                           QString::fromStdString(sessions.write({.name = "one"}).string()),
                           QString::fromStdString(sessions.write({.name = "two"}).string())};
    const QStringList bad{write("words.csv", "no numbers here\n"),
                          write("empty.csv", ""),
                          write("no.tacto", "this is no session"),
                          write("recording.json", "{"),
                          write("a.txt", "text"),
                          folder.filePath("not-there.csv"),
                          folder.filePath("not-there.tacto"),
                          folder.path()};
    std::mt19937 random(4933);
    std::vector<QString> order(good.begin(), good.end());
    order.insert(order.end(), bad.begin(), bad.end());
    std::ranges::shuffle(order, random);
    QStringList expected;
    for (const auto& path : order) {
        window.openFile(path);
        if (!good.contains(path)) {
            letLive(200);
            continue;
        }
        expected.prepend(path);
        ASSERT_IN_TIME(comesTrue([&] { return recent().front() == path; })) << path.toStdString();
        const auto name = QFileInfo(path).fileName();
        EXPECT_IN_TIME(comesTrue([&] { return window.windowTitle() == name + " – Tactoscope"; }))
            << window.windowTitle().toStdString();
    }
    letLive(300);
    EXPECT_EQ(recent(), expected);
    for (const auto& path : expected)
        EXPECT_EQ(window.windowTitle().count(QFileInfo(path).fileName()) > 0, path == expected.front())
            << window.windowTitle().toStdString();
    ASSERT_TRUE(QFile::remove(good[0]));
    expected.removeAll(good[0]);
    EXPECT_EQ(recent(), expected) << "one that is gone would not open";
    std::ofstream(good[1].toStdString()) << "no numbers here any more\n";
    window.openFile(good[1]);
    expected.removeAll(good[1]);
    EXPECT_IN_TIME(comesTrue([&] { return recent() == expected; })) << "one that does not open any more is taken out";
}

TEST_F(FileMenu, HasTheEntriesAndKeysOfEveryDesktop) {
    const std::pair<const char*, QKeySequence> wanted[] = {
        {"Open…", QKeySequence::Open},   {"Save picture…", QKeySequence::Save}, {"Export…", Qt::CTRL | Qt::Key_E},
        {"Print…", QKeySequence::Print}, {"Close", QKeySequence::Close},        {"Quit", Qt::CTRL | Qt::Key_Q}};
    for (const auto& [text, key] : wanted) {
        ASSERT_NE(entry(text), nullptr) << text;
        EXPECT_EQ(entry(text)->shortcut(), key) << text;
    }
    std::map<QKeySequence, QStringList> used;
    for (auto* action : window.findChildren<QAction*>())
        if (!action->shortcut().isEmpty()) used[action->shortcut()] << action->text();
    for (const auto& [key, texts] : used)
        EXPECT_EQ(texts.size(), 1) << key.toString().toStdString() << ": " << texts.join(", ").toStdString();
}

TEST_F(FileMenu, DoesWhatThePageHasAndSaysWhyNotTheRest) {
    const char* acts[] = {"Save picture…", "Export…", "Print…", "Close"};
    const auto offered = [&] {
        emit menu().aboutToShow();
        QStringList all;
        for (const auto* act : acts) {
            if (entry(act)->isEnabled())
                all << act;
            else
                EXPECT_FALSE(entry(act)->toolTip().isEmpty()) << act;
        }
        emit menu().aboutToHide();
        return all;
    };
    visit(gui::Workspaces::kProtocols);
    EXPECT_EQ(offered(), QStringList());
    for (const auto* act : acts) {
        const auto before = message();
        entry(act)->trigger();
        EXPECT_NE(message(), before) << act << ": the key says why";
    }
    const auto path = write("a.csv", samples());
    window.openFile(path);
    ASSERT_IN_TIME(comesTrue([&] { return window.windowTitle() == "a.csv – Tactoscope"; }));
    EXPECT_EQ(offered(), QStringList({"Save picture…", "Export…", "Print…"}));
    const auto saves = [&](const char* act, const char* name, const QByteArray& begins) {
        entry(act)->trigger();
        auto* chooser = window.findChild<QFileDialog*>("fileChooser");
        ASSERT_NE(chooser, nullptr) << act;
        chooser->selectFile(folder.filePath(name));
        QMetaObject::invokeMethod(chooser, "accept");
        chooser->deleteLater();
        QFile file(folder.filePath(name));
        ASSERT_IN_TIME(comesTrue([&] { return file.exists(); })) << act;
        ASSERT_TRUE(file.open(QIODevice::ReadOnly));
        EXPECT_TRUE(file.readAll().startsWith(begins)) << act;
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    };
    saves("Save picture…", "picture.png", "\x89PNG");
    saves("Export…", "data.csv", "time_s,");
    entry("Print…")->trigger();
    auto* printers = window.findChild<QMenu*>("printers");
    ASSERT_NE(printers, nullptr);
    EXPECT_FALSE(printers->actions().isEmpty()) << "printers, or that there is none";
    printers->close();
    window.openSimulatedBench();
    ASSERT_IN_TIME(comesTrue([&] { return window.controller().activity() == gui::Activity::Live; }));
    EXPECT_TRUE(offered().contains("Close"));
    window.findChild<gui::Workspaces*>()->showLive(gui::Workspaces::kTouch);
    saves("Save picture…", "touch.png", "\x89PNG");
    EXPECT_TRUE(message().contains("touch.png")) << message().toStdString();
    entry("Close")->trigger();
    EXPECT_IN_TIME(comesTrue([&] { return window.controller().activity() == gui::Activity::Closed; }));
}

TEST_F(FileMenu, WhatARunRecordedIsRecentToo) {
    RecordProperty("hazard", "H11");
    const WrittenSessions sessions;
    const auto run = std::make_shared<gui::FinishedRun>();
    run->result.session = sessions.write({.name = "run"});
    emit window.controller().finished(run);
    const auto recorded = QString::fromStdString(run->result.session.string());
    EXPECT_EQ(recent().front(), recorded);
    const auto elsewhere = std::make_shared<gui::FinishedRun>();
    elsewhere->result.session = write("study.tacto", "sealed").toStdString();
    emit window.controller().finished(elsewhere);
    EXPECT_EQ(recent().front(), recorded) << "a study's session is named nowhere else";
}

TEST_F(FileMenu, SavesThePlotOfAPageThatHasNoButtonsForIt) {
    const WrittenSessions sessions;
    window.openFile(QString::fromStdString(sessions.write({.name = "one"}).string()));
    ASSERT_IN_TIME(comesTrue([this] {
        emit menu().aboutToShow();
        return entry("Save picture…")->isEnabled();
    })) << "the session's trials in the plane";
    emit menu().aboutToHide();
    const auto path = folder.filePath("trials.svg");
    const auto wrong = window.findChild<gui::Workspaces*>()->savePicture(path);
    EXPECT_FALSE(wrong) << wrong->toStdString();
    QFile file(path);
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    EXPECT_TRUE(file.readAll().contains("<svg"));
}

}  // namespace
}  // namespace tacto::test
