// Tests that all dialogs open in the same way, next to the window, and take no click or key from STOP.
#include <QAbstractButton>
#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QMessageBox>
#include <QPushButton>
#include <QRegularExpression>
#include <QTest>
#include <gmock/gmock.h>

#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/EntryFields.h"
#include "app/gui/window/StopKeys.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

TEST(Dialogs, AreOpenedInOneWayOnly) {
    RecordProperty("hazard", "H2");
    const QRegularExpression forbidden(
        R"(\bexec\(|->open\(\)|\bsetModal\(|Window(Modal|Modality)\b|ApplicationModal|QFileDialog)"
        R"(|QMessageBox::(question|warning|information|critical|about)\()"
        R"(|Q(Input|Color|Font|Print|Progress)Dialog|QErrorMessage|QWizard|QDrag\b)");
    const QRegularExpression allowed("QApplication::exec\\(|prompt_->open\\(\\)");
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(sourceDir() / "app" / "gui")) {
        const auto name = entry.path().filename().string();
        if ((entry.path().extension() != ".cpp" && entry.path().extension() != ".h") || name == "Dialogs.cpp" ||
            name == "StopKeys.cpp")
            continue;
        QFile file(QString::fromStdString(entry.path().string()));
        ASSERT_TRUE(file.open(QIODevice::ReadOnly));
        ++files;
        auto text = QString::fromUtf8(file.readAll());
        const auto found = forbidden.match(text.remove(allowed));
        EXPECT_FALSE(found.hasMatch()) << name << ": " << found.captured().toStdString() << " (use theme/Dialogs.h)";
    }
    EXPECT_GT(files, 100);
}

class Asking : public testing::Test {
protected:
    Asking() {
        window.resize(600, 400);
        window.show();
        EXPECT_IN_TIME(QTest::qWaitForWindowExposed(&window));
    }
    [[nodiscard]] QFileDialog* chooser() { return window.findChild<QFileDialog*>("fileChooser"); }
    [[nodiscard]] QString trouble() {
        const auto* label = chooser()->findChild<QLabel*>("fileTrouble");
        return label->isVisible() ? label->text() : QString();
    }
    void ask(gui::FileQuestion::Wants wants) {
        gui::FileQuestion question;
        question.title = "Choose";
        question.wants = wants;
        question.folder = QString::fromStdString(folder.path().string());
        gui::askForFile(window, question, [this](const QString& path) { chosen << path; });
        ASSERT_NE(chooser(), nullptr);
        ASSERT_TRUE(QTest::qWaitForWindowExposed(chooser()));
    }
    void answer(const QString& name) {
        auto* line = chooser()->findChild<QLineEdit*>("fileNameEdit");
        ASSERT_NE(line, nullptr);
        line->setText(name);
        static_cast<QDialog*>(chooser())->accept();
    }
    const ScratchDir folder;
    QWidget window;
    QStringList chosen;
};

TEST_F(Asking, DoesNotBlockTheWindow) {
    RecordProperty("hazard", "H2");
    ask(gui::FileQuestion::Wants::ExistingFile);
    EXPECT_FALSE(chooser()->isModal());
    EXPECT_EQ(chooser()->windowHandle()->modality(), Qt::NonModal);
}

TEST_F(Asking, BeginsWhereSomethingWasChosenLast) {
    std::filesystem::create_directories(folder.path() / "deep" / "study");
    ask(gui::FileQuestion::Wants::Folder);
    answer(QString::fromStdString((folder.path() / "deep" / "study").string()));  // typed, not walked to
    ASSERT_EQ(chosen.size(), 1);
    letLive(20);
    gui::FileQuestion question;
    question.title = "Choose again";
    gui::askForFile(window, question, [](const QString&) {});
    auto* again = window.findChildren<QFileDialog*>("fileChooser").last();
    EXPECT_EQ(again->directory().absolutePath().toStdString(), (folder.path() / "deep").string());
}

TEST_F(Asking, ANewFolderIsChosenBesideTheOneThatIsProposed) {
    const auto proposed = QString::fromStdString((folder.path() / "not" / "yet" / "made").string());
    gui::FolderRow row(proposed, "Where it goes", "The folder", &window);
    row.show();
    click(*row.findChild<QPushButton*>());
    auto* shown = row.findChild<QFileDialog*>("fileChooser");
    ASSERT_NE(shown, nullptr);
    EXPECT_EQ(shown->directory().absolutePath().toStdString(), folder.path().string());
}

TEST_F(Asking, AFileIsReplacedOnlyAfterASecondPress) {
    const auto old = folder.write("old.json", "{}");
    ask(gui::FileQuestion::Wants::NewFile);
    answer("old.json");
    EXPECT_TRUE(chosen.isEmpty());
    EXPECT_THAT(trouble().toStdString(), HasSubstr("old.json exists"));
    answer("old.json");
    EXPECT_EQ(chosen, QStringList(QString::fromStdString(old.string())));
}

TEST_F(Asking, TheSecondPressIsForThatFileAlone) {
    static_cast<void>(folder.write("one.json", "{}"));
    static_cast<void>(folder.write("two.json", "{}"));
    ask(gui::FileQuestion::Wants::NewFile);
    answer("one.json");
    answer("two.json");
    EXPECT_TRUE(chosen.isEmpty());
    EXPECT_THAT(trouble().toStdString(), HasSubstr("two.json exists"));
}

TEST_F(Asking, AFileThatIsNotThereIsSaidInPlace) {
    ask(gui::FileQuestion::Wants::ExistingFile);
    answer("missing.json");
    EXPECT_TRUE(chosen.isEmpty());
    EXPECT_THAT(trouble().toStdString(), HasSubstr("missing.json is not there"));
}

// Qt does not list such a name. It comes from elsewhere, with a replacement for the byte that is invalid in UTF-8.
TEST_F(Asking, AFileWhoseNameIsNotUtf8IsSaidInPlace) {
    static_cast<void>(folder.write("caf\xE9.json", "{}"));
    ask(gui::FileQuestion::Wants::ExistingFile);
    answer(QString("caf") + QChar(QChar::ReplacementCharacter) + ".json");
    EXPECT_TRUE(chosen.isEmpty());
    EXPECT_THAT(trouble().toStdString(), HasSubstr("is not UTF-8"));
}

TEST_F(Asking, AComplaintIsGoneOnceAnotherNameIsTyped) {
    ask(gui::FileQuestion::Wants::ExistingFile);
    answer("missing.json");
    ASSERT_FALSE(trouble().isEmpty());
    chooser()->findChild<QLineEdit*>("fileNameEdit")->setText("other");
    EXPECT_TRUE(trouble().isEmpty());
}

TEST_F(Asking, ANewFolderIsMadeByItsNameWhereOneIsAskedFor) {
    ask(gui::FileQuestion::Wants::Folder);
    answer("shared");
    EXPECT_TRUE(chosen.isEmpty());
    EXPECT_THAT(trouble().toStdString(), HasSubstr("shared is not there"));
    chooser()->close();
    letLive(20);
    ask(gui::FileQuestion::Wants::NewFolder);
    answer("shared");
    const auto made = folder.path() / "shared";
    EXPECT_EQ(chosen, QStringList(QString::fromStdString(made.string())));
    EXPECT_TRUE(std::filesystem::is_directory(made));
}

TEST_F(Asking, AFolderThatCannotBeMadeIsSaidInPlace) {
    static_cast<void>(folder.write("file", "in the way"));
    ask(gui::FileQuestion::Wants::NewFolder);
    answer(QString::fromStdString((folder.path() / "file" / "shared").string()));
    EXPECT_TRUE(chosen.isEmpty());
    EXPECT_THAT(trouble().toStdString(), HasSubstr("shared cannot be made there"));
}

TEST(OnDesktop, WithoutAProgramForItThePlaceIsSaid) {
    // There is no desktop on the offscreen platform.
    EXPECT_EQ(gui::openOnDesktop("/home/lab/report.pdf"),
              "This desktop has no program that opens /home/lab/report.pdf.");
}

TEST_F(Asking, TwiceShowsTheQuestionThatIsOpen) {
    ask(gui::FileQuestion::Wants::ExistingFile);
    auto* first = chooser();
    ask(gui::FileQuestion::Wants::ExistingFile);
    letLive(20);
    EXPECT_EQ(window.findChildren<QFileDialog*>().size(), 1);
    EXPECT_EQ(chooser(), first);
}

TEST_F(Asking, ABoxThatALibraryOpensLosesItsModality) {
    RecordProperty("hazard", "H2");
    const gui::StopKeys keys([](const char*) {}, nullptr);
    auto modality = Qt::ApplicationModal;
    QTimer::singleShot(50, [&] {
        auto* box = window.findChild<QMessageBox*>();
        ASSERT_NE(box, nullptr);
        modality = box->windowHandle()->modality();
        box->close();
    });
    QMessageBox::warning(&window, "Not ours", "Opened with exec().");
    EXPECT_EQ(modality, Qt::NonModal);
}

}  // namespace
}  // namespace tacto::test
