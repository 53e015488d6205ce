#include <QTemporaryDir>
#include <gtest/gtest.h>

#include "app/gui/window/StartedWith.h"
#include "core/base/ProgramVersion.h"

namespace tacto::test {
namespace {

using gui::StartedWith;

StartedWith startedWith(QStringList arguments) {
    arguments.prepend("tactoscope");
    return StartedWith::read(arguments);
}

void expectAnswer(const QStringList& arguments, int exitCode, const QString& text) {
    const auto answer = startedWith(arguments).answer;
    ASSERT_TRUE(answer) << arguments.join(' ').toStdString();
    EXPECT_EQ(answer->exitCode, exitCode);
    EXPECT_TRUE(answer->text.startsWith(text)) << answer->text.toStdString();
    EXPECT_TRUE(startedWith(arguments).file.isEmpty());
}

TEST(StartedWithTest, NothingOpensTheWindow) {
    EXPECT_FALSE(startedWith({}).answer);
    EXPECT_TRUE(startedWith({}).file.isEmpty());
}

TEST(StartedWithTest, AFileThatExistsIsOpened) {
    const QTemporaryDir folder;
    EXPECT_FALSE(startedWith({folder.path()}).answer);
    EXPECT_EQ(startedWith({folder.path()}).file, folder.path());
    EXPECT_EQ(startedWith({"--", folder.path()}).file, folder.path());
}

TEST(StartedWithTest, AFileThatDoesNotExistIsNamed) {
    expectAnswer({"/nowhere/run.tacto"}, 3, "tactoscope: /nowhere/run.tacto does not exist");
}

TEST(StartedWithTest, SaysItsHelpAndVersion) {
    for (const auto* word : {"--help", "-h"}) expectAnswer({word, "/nowhere"}, 0, "usage: tactoscope [FILE]");
    for (const auto* word : {"--version", "-v"})
        expectAnswer({word}, 0, QString("tactoscope %1").arg(programVersion().version));
    // An option of Qt that contains an h.
    expectAnswer({"-stylesheet", "x.qss"}, 2, "tactoscope: Unknown option 'stylesheet'");
}

TEST(StartedWithTest, WhatItDoesNotKnowIsRefused) {
    expectAnswer({"--device"}, 2, "tactoscope: Unknown option 'device'; --help, --version or a FILE is expected");
    expectAnswer({"/", "/tmp"}, 2, "tactoscope: 2 files are given; one FILE is expected");
}

}  // namespace
}  // namespace tacto::test
