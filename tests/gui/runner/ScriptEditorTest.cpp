// Tests the editor of the laboratory's own protocols with keys and mouse.
#include <gmock/gmock.h>

#include "tests/gui/runner/Lab.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class Editor : public Lab {
protected:
    gui::ScriptEditor& opened() {
        if (!comesTrue([this] { return editor() != nullptr; })) throw std::runtime_error("the editor has not opened");
        return *editor();
    }
    template <class T>
    T& in(const QString& name) {
        T* found = nullptr;
        if (!comesTrue([&] { return (found = find<T>(opened(), name)) != nullptr; }))
            throw std::runtime_error("the editor shows no " + name.toStdString());
        return *found;
    }
    QString says(const char* label) { return in<QLabel>(label).text(); }
    QString message() { return in<QLabel>("scriptMessage").text(); }
    static void replaceText(gui::ScriptEditor& editor, const QString& text) {
        editor.code().setFocus();
        QTest::keyClick(&editor.code(), Qt::Key_A, Qt::ControlModifier);
        for (const auto& line : text.split('\n')) {
            QTest::keyClicks(&editor.code(), line);
            QTest::keyClick(&editor.code(), Qt::Key_Return);
        }
    }
};

TEST_F(Editor, WritesANewProtocolFromTheTemplateAndOffersItToRun) {
    open("");
    ASSERT_IN_TIME(ready());
    click(the<QPushButton>("New…"));
    shot(opened(), "editor");
    click(in<QPushButton>("Check"));
    ASSERT_IN_TIME(comesTrue([this] { return message().contains("reads well"); })) << message().toStdString();
    click(in<QPushButton>("Run…"));
    auto& name = in<QLineEdit>("protocolName");
    name.selectAll();
    QTest::keyClicks(&name, "no/good");
    click(in<QPushButton>("Save as"));
    EXPECT_THAT(message().toStdString(), HasSubstr("not a name for a protocol"));
    name.selectAll();
    QTest::keyClicks(&name, "bend");
    QTest::keyClick(&name, Qt::Key_Return);
    EXPECT_TRUE(std::filesystem::exists(userProtocolsFolder() / "bend.js"));
    EXPECT_EQ(the<QComboBox>("chooser").currentData().toString(), "bend");
    ASSERT_IN_TIME(ready());
    ASSERT_IN_TIME(comesTrue(
        [this] { return workspace->isActiveWindow() && workspace->isAncestorOf(QApplication::focusWidget()); }));
    QTest::keyClick(workspace.get(), Qt::Key_F5);
    ASSERT_IN_TIME(ends());
    EXPECT_FALSE(ended->result.outcome.error) << ended->result.outcome.error->message;
}

TEST_F(Editor, MarksTheLineOfAnErrorWhileSomebodyTypes) {
    open("");
    ASSERT_IN_TIME(ready());
    click(the<QPushButton>("New…"));
    replaceText(opened(), "protocol({ title: 'T', purpose: 'P', needs: [], parameters: {} });\nfunction run(p) { (\n");
    ASSERT_IN_TIME(comesTrue([this] { return opened().code().marked() > 1; }));
    EXPECT_THAT(message().toStdString(), HasSubstr("SyntaxError"));
    replaceText(opened(), "protocol({ title: 'T', purpose: 'P', needs: [], parameters: {} });\nfunction run(p) {}\n");
    ASSERT_IN_TIME(comesTrue([this] { return opened().code().marked() == 0; }));
}

TEST_F(Editor, AShippedProtocolIsReadOnlyAndSavesAsACopy) {
    open("");
    choose("separability");
    ASSERT_IN_TIME(ready());
    click(the<QPushButton>("Edit…"));
    const auto before = opened().code().text();
    QTest::keyClicks(&opened().code(), "zzz");
    EXPECT_EQ(opened().code().text(), before);
    click(in<QPushButton>("Save a copy…"));
    QTest::keyClick(&in<QLineEdit>("protocolName"), Qt::Key_Return);
    EXPECT_TRUE(std::filesystem::exists(userProtocolsFolder() / "my-separability.js"));
    QTest::keyClicks(&opened().code(), "//");
    EXPECT_NE(opened().code().text(), before) << "the copy is the lab's own";
}

TEST_F(Editor, AsksBeforeItLosesAnything) {
    open("");
    ASSERT_IN_TIME(ready());
    click(the<QPushButton>("New…"));
    QTest::keyClicks(&opened().code(), "// mine");
    QTest::keyClick(&opened().code(), Qt::Key_Escape);  // no key of the text
    EXPECT_TRUE(opened().isVisible());
    click(in<QPushButton>("Keep editing"));
    EXPECT_THAT(opened().code().text().toStdString(), HasSubstr("// mine"));
    click(in<QPushButton>("Close"));
    click(in<QPushButton>("Discard the changes"));
    EXPECT_IN_TIME(comesTrue([this] { return editor() == nullptr; }));
}

TEST_F(Editor, FindsWordsRoundTheText) {
    open("");
    ASSERT_IN_TIME(ready());
    click(the<QPushButton>("New…"));
    ASSERT_IN_TIME(comesTrue([this] { return opened().isActiveWindow(); }));
    auto& code = opened().code();
    const auto count = code.text().count("bench", Qt::CaseInsensitive);
    ASSERT_GT(count, 2);
    code.setCursorPosition(0, 0);
    QTest::keyClick(&code, Qt::Key_F, Qt::ControlModifier);
    auto& words = in<QLineEdit>("findWords");
    EXPECT_TRUE(words.hasFocus());
    QTest::keyClicks(&words, "BENCH");
    EXPECT_EQ(says("findCount").toStdString(), QString("1 of %1").arg(count).toStdString()) << "case does not count";
    EXPECT_EQ(code.selectedText(), "bench");
    QTest::keyClick(&words, Qt::Key_Return);
    EXPECT_TRUE(says("findCount").startsWith("2 of "));
    QTest::keyClick(&words, Qt::Key_Return, Qt::ShiftModifier);
    QTest::keyClick(&words, Qt::Key_Return, Qt::ShiftModifier);
    EXPECT_EQ(says("findCount").toStdString(), QString("%1 of %1, from the end").arg(count).toStdString());
    click(in<QPushButton>("findNext"));
    EXPECT_EQ(says("findCount").toStdString(), QString("1 of %1, from the top").arg(count).toStdString());
    shot(opened(), "editor-find");
    QTest::keyClicks(&words, "xyz");
    EXPECT_EQ(says("findCount").toStdString(), "no match");
    EXPECT_FALSE(in<QPushButton>("findNext").isEnabled());
    QTest::keyClick(&words, Qt::Key_Escape);
    EXPECT_FALSE(words.isVisible());
    EXPECT_TRUE(opened().isVisible()) << "the first Esc closes the search, not the editor";
    EXPECT_TRUE(code.hasFocus());
}

TEST_F(Editor, SaysWhyItCouldNotSave) {
    open("");
    ASSERT_IN_TIME(ready());
    std::filesystem::create_directories(userProtocolsFolder().parent_path());
    std::ofstream(userProtocolsFolder()) << "a file where the folder belongs";
    click(the<QPushButton>("New…"));
    ASSERT_IN_TIME(comesTrue([this] { return opened().isActiveWindow(); }));
    QTest::keyClick(&opened().code(), Qt::Key_S, Qt::ControlModifier);
    QTest::keyClick(&in<QLineEdit>("protocolName"), Qt::Key_Return);
    EXPECT_THAT(message().toStdString(), HasSubstr("Not saved"));
    EXPECT_FALSE(opened().code().text().isEmpty());
}

}  // namespace
}  // namespace tacto::test
