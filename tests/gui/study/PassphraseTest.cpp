// Tests a passphrase in the window: typed into locked memory, shown as dots, refused in place if wrong.
#include <QClipboard>
#include <QDialogButtonBox>
#include <QSettings>
#include <QSignalSpy>

#include "app/gui/study/PassphraseDialog.h"
#include "tests/gui/study/OpenedStudy.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

std::string textOf(const Secret& secret) {
    return {reinterpret_cast<const char*>(secret.bytes().data()), secret.size()};
}

TEST(PassphraseEdit, HoldsWhatIsTypedAndShowsDots) {
    RecordProperty("hazard", "H11");
    gui::PassphraseEdit edit;
    edit.show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&edit));
    QTest::keyClicks(&edit, "geheim 42");
    EXPECT_EQ(textOf(edit.typed()), "geheim 42");
    EXPECT_EQ(edit.text(), QString(9, u'●')) << "no copy of it is in the line";
    QTest::keyClick(&edit, Qt::Key_Backspace);
    EXPECT_EQ(textOf(edit.typed()), "geheim 4");
    QGuiApplication::clipboard()->setText("ü€\n");
    QTest::keyClick(&edit, Qt::Key_V, Qt::ControlModifier);
    EXPECT_EQ(textOf(edit.typed()), "geheim 4ü€") << "letters of several bytes, and no line end";
    QTest::keyClick(&edit, Qt::Key_Backspace);
    EXPECT_EQ(textOf(edit.typed()), "geheim 4ü") << "a letter, not a byte";
    QTest::keyClick(&edit, Qt::Key_C, Qt::ControlModifier);
    EXPECT_EQ(QGuiApplication::clipboard()->text(), "ü€\n") << "nothing of it is copied";
    edit.wipe();
    EXPECT_TRUE(edit.isEmpty());
    EXPECT_TRUE(edit.text().isEmpty());
}

/// A study is lost with its passphrase, so what looks replaced must be.
TEST(PassphraseEdit, WhatIsSelectedIsReplaced) {
    RecordProperty("hazard", "H11");
    gui::PassphraseEdit edit;
    edit.show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&edit));
    const std::pair<const char*, std::function<void()>> selects[] = {
        {"Ctrl+A", [&] { QTest::keyClick(&edit, Qt::Key_A, Qt::ControlModifier); }},
        {"a double click", [&] { QTest::mouseDClick(&edit, Qt::LeftButton); }},
        {"Tab",
         [&] {
             edit.clearFocus();
             edit.setFocus(Qt::TabFocusReason);
         }},
    };
    const std::pair<const char*, std::function<void()>> replaces[] = {
        {"typing", [&] { QTest::keyClicks(&edit, "other"); }},
        {"Backspace",
         [&] {
             QTest::keyClick(&edit, Qt::Key_Backspace);
             QTest::keyClicks(&edit, "other");
         }},
        {"Delete",
         [&] {
             QTest::keyClick(&edit, Qt::Key_Delete);
             QTest::keyClicks(&edit, "other");
         }},
        {"pasting",
         [&] {
             QGuiApplication::clipboard()->setText("other");
             QTest::keyClick(&edit, Qt::Key_V, Qt::ControlModifier);
         }},
    };
    for (const auto& [how, select] : selects) {
        for (const auto& [what, replace] : replaces) {
            edit.wipe();
            QTest::keyClicks(&edit, "first");
            select();
            ASSERT_EQ(edit.selectedText().size(), 5) << how;
            replace();
            EXPECT_EQ(textOf(edit.typed()), "other") << how << ", " << what;
        }
    }
    QTest::mouseClick(&edit, Qt::LeftButton);
    QTest::keyClicks(&edit, "s");
    EXPECT_EQ(textOf(edit.typed()), "others") << "a click selects nothing";
}

TEST(PassphraseEdit, TakesNoMoreThanItHasRoomFor) {
    RecordProperty("hazard", "H11");
    gui::PassphraseEdit edit;
    QGuiApplication::clipboard()->setText(QString(5000, 'x'));
    QTest::keyClick(&edit, Qt::Key_V, Qt::ControlModifier);
    EXPECT_EQ(edit.typed().size(), gui::PassphraseEdit::kMaxBytes);
}

TEST_F(StudyInThePage, AWrongPassphraseIsOneSentenceAndIsAskedAgain) {
    RecordProperty("hazard", "H11");
    make();
    page.open(folder());
    auto* asks = dialog("passphraseDialog");
    ASSERT_NE(asks, nullptr);
    auto* line = asks->findChild<QLineEdit*>("passphrase");
    auto* trouble = asks->findChild<QLabel*>("passphraseTrouble");
    QTest::keyClicks(line, "wrong");
    click(*asks->findChild<QPushButton*>("usePassphrase"));
    ASSERT_IN_TIME(comesTrue([&] { return trouble->text().startsWith("⚠"); }));
    EXPECT_THAT(trouble->text().toStdString(), HasSubstr("passphrase"));
    EXPECT_FALSE(trouble->text().contains(". ")) << "one sentence: " << trouble->text().toStdString();
    EXPECT_TRUE(line->text().isEmpty());
    EXPECT_EQ(study.study(), nullptr);
    looksRight(*asks, "passphrase-wrong", {QSize(), QSize(1000, 680)});
    QTest::keyClicks(line, kWords);
    QTest::keyClick(line, Qt::Key_Return);
    ASSERT_IN_TIME(comesTrue([this] { return study.study() != nullptr; }));
    EXPECT_TRUE(study.study()->hasKey());
    for (const auto& key : QSettings().allKeys())
        EXPECT_FALSE(QSettings().value(key).toString().contains("correct horse")) << key.toStdString();
}

TEST_F(StudyInThePage, CancelledWhileThePassphraseIsTriedNothingIsOpened) {
    RecordProperty("hazard", "H11");
    make();
    page.open(folder());
    auto* asks = qobject_cast<gui::PassphraseDialog*>(dialog("passphraseDialog"));
    ASSERT_NE(asks, nullptr);
    QSignalSpy opened(&study, &gui::OpenStudy::opened);
    QObject::connect(asks, &gui::PassphraseDialog::given, asks, [asks] { QTest::keyClick(asks, Qt::Key_Escape); });
    QTest::keyClicks(asks->findChild<QLineEdit*>("passphrase"), kWords);
    click(*asks->findChild<QPushButton*>("usePassphrase"));
    ASSERT_IN_TIME(comesTrue([this] { return !study.busy() && dialog("passphraseDialog") == nullptr; }));
    EXPECT_EQ(opened.count(), 0);
    EXPECT_EQ(study.study(), nullptr);
    EXPECT_EQ(study.passphrase(), nullptr);
    const auto words = Passphrase::from(kWords).value();
    EXPECT_TRUE(Study::open(folder().toStdString(), &words, Study::Access::Change, around())) << "it is locked still";
    open();
}

TEST(PassphraseDialog, WhileAStudyIsMadeItCannotBeCancelled) {
    gui::PassphraseDialog asks(gui::PassphraseDialog::Purpose::New, "Four conditions", nullptr);
    asks.show();
    auto* cancel = asks.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Cancel);
    EXPECT_TRUE(cancel->isEnabled());
    QTest::keyClicks(asks.findChild<QLineEdit*>("passphrase"), kWords);
    QTest::keyClicks(asks.findChild<QLineEdit*>("passphraseAgain"), kWords);
    click(*asks.findChild<QPushButton*>("usePassphrase"));
    EXPECT_FALSE(cancel->isEnabled());
    asks.reject();
    EXPECT_TRUE(asks.isVisible());
    asks.refuse("There is no room.");
    EXPECT_TRUE(cancel->isEnabled());
    asks.reject();
    EXPECT_FALSE(asks.isVisible());
}

TEST_F(StudyInThePage, ClosingForgetsThePassphraseAndLetsOthersIn) {
    RecordProperty("hazard", "H11");
    make();
    open();
    const auto words = Passphrase::from(kWords).value();
    EXPECT_FALSE(Study::open(folder().toStdString(), &words, Study::Access::Change, around()))
        << "one program at a time";
    press("closeStudy");
    EXPECT_EQ(study.passphrase(), nullptr);
    EXPECT_TRUE(Study::open(folder().toStdString(), &words, Study::Access::Change, around()));
}

}  // namespace
}  // namespace tacto::test
