// Tests the program's file chooser while a session is being recorded.
#include <QDialogButtonBox>
#include <QDir>
#include <QFileDialog>
#include <QLineEdit>
#include <QPointer>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTest>
#include <QTreeView>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "app/gui/theme/Dialogs.h"
#include "tests/gui/Person.h"
#include "tests/gui/RoomLooks.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

/// True if another process would find the first byte of the file locked.
bool isLocked(const QByteArray& path) {
    const pid_t child = ::fork();
    if (child == 0) {
        const int file = ::open(path.constData(), O_RDWR);
        struct flock lock {};
        lock.l_type = F_WRLCK;
        lock.l_whence = SEEK_SET;
        lock.l_len = 1;
        const bool asked = file >= 0 && ::fcntl(file, F_GETLK, &lock) == 0;
        ::_exit(asked && lock.l_type != F_UNLCK ? 1 : 0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 1;
}

/// A process that closes any descriptor of a file loses all its locks on it, also SQLite's. The next program to open
/// the session would then truncate its index during writing, and the writer would end with SIGBUS.
TEST(FileChooser, OpensNoneOfTheFilesThatItLists) {
    RecordProperty("hazard", "H8");
    const QTemporaryDir folder;
    for (const char* name : {"session.tacto", "session.tacto-wal", "session.tacto-shm", "capture.csv", "nameless"}) {
        QFile file(folder.filePath(name));
        ASSERT_TRUE(file.open(QIODevice::WriteOnly));
        file.write("something to look at\n");
    }
    const auto path = folder.filePath("session.tacto-shm").toUtf8();
    const int held = ::open(path.constData(), O_RDWR);
    ASSERT_GE(held, 0);
    struct flock lock {};
    lock.l_type = F_RDLCK;
    lock.l_whence = SEEK_SET;
    lock.l_len = 1;
    ASSERT_EQ(::fcntl(held, F_SETLK, &lock), 0);
    ASSERT_TRUE(isLocked(path));

    QWidget asking;
    asking.show();
    for (const auto& shown : {folder.path(), QString()}) {  // the second round starts in the folder of the first
        gui::FileQuestion question;
        question.title = "Open";
        question.folder = shown;
        gui::askForFile(asking, question, [](const QString&) {});
        const QPointer dialog = asking.findChild<QFileDialog*>();
        ASSERT_NE(dialog, nullptr);
        dialog->setFilter(QDir::AllEntries | QDir::Hidden);
        ASSERT_IN_TIME(comesTrue([&] { return dialog->isVisible(); }));
        for (const auto view : {QFileDialog::Detail, QFileDialog::List}) {
            dialog->setViewMode(view);
            letLive(500);  // the chooser reads files on its own thread
        }
        EXPECT_TRUE(isLocked(path)) << shown.toStdString();
        dialog->selectFile(folder.filePath("capture.csv"));
        static_cast<QDialog*>(dialog.data())->done(QDialog::Accepted);
        ASSERT_IN_TIME(comesTrue([&] { return dialog.isNull(); }));
    }
    ::close(held);
}

TEST(FileChooser, ANewFolderIsMadeByTheButtonToo) {
    const QTemporaryDir folder;
    QWidget asking;
    asking.show();
    QStringList chosen;
    const gui::FileQuestion question{.title = "A new or empty folder",
                                     .wants = gui::FileQuestion::Wants::NewFolder,
                                     .folder = folder.path(),
                                     .name = "shared"};
    gui::askForFile(asking, question, [&](const QString& path) { chosen << path; });
    auto* dialog = asking.findChild<QFileDialog*>();
    ASSERT_NE(dialog, nullptr);
    ASSERT_IN_TIME(comesTrue([&] { return dialog->isVisible(); }));
    letLive(300);  // the chooser lists the folder on its own thread, and looks at its button then
    auto* choose = dialog->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Open);
    auto* name = dialog->findChild<QLineEdit*>("fileNameEdit");
    EXPECT_TRUE(choose->isEnabled()) << name->text().toStdString();
    name->clear();
    EXPECT_FALSE(choose->isEnabled()) << "without a name";
    QTest::keyClicks(name, "mine");
    ASSERT_TRUE(choose->isEnabled());
    choose->click();
    ASSERT_EQ(chosen, QStringList{folder.filePath("mine")});
    EXPECT_TRUE(QDir(chosen.front()).exists());
}

TEST(FileChooser, ShowsNamesAndDatesWhole) {
    const QTemporaryDir folder;
    for (const char* name : {"live-20261127T123849Z.tacto", "separability-20261127T124201Z.tacto", "capture.csv"}) {
        QFile file(folder.filePath(name));
        ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    }
    QWidget asking;
    asking.show();
    gui::FileQuestion question;
    question.title = "Save";
    question.wants = gui::FileQuestion::Wants::NewFile;
    question.folder = folder.path();
    gui::askForFile(asking, question, [](const QString&) {});
    auto* dialog = asking.findChild<QFileDialog*>();
    ASSERT_NE(dialog, nullptr);
    const auto* list = dialog->findChild<QTreeView*>("treeView");
    ASSERT_IN_TIME(comesTrue([&] { return list->model()->rowCount(list->rootIndex()) == 3; }));
    EXPECT_IN_TIME(comesTrue([&] { return cutCells(*dialog).isEmpty() && cutSideways(*dialog).isEmpty(); }))
        << cutCells(*dialog).join('\n').toStdString() << cutSideways(*dialog).join('\n').toStdString();
    shot(*dialog, "file-chooser");
    dialog->close();
}

}  // namespace
}  // namespace tacto::test
