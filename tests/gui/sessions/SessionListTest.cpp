// Tests the list of sessions: five thousand at once, found by their texts, and never trusted against a session itself.
#include <QComboBox>
#include <QDir>
#include <QElapsedTimer>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollBar>
#include <QTableView>
#include <QTest>
#include <QTextBrowser>
#include <gmock/gmock.h>
#include <sqlite3.h>

#include "app/gui/controller/BenchController.h"
#include "app/gui/runner/TrialPlane.h"
#include "app/gui/sessions/SessionModel.h"
#include "app/gui/sessions/SessionWords.h"
#include "app/gui/sessions/SessionsWorkspace.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Theme.h"
#include "core/session/Digest.h"
#include "core/session/SessionLabels.h"
#include "core/session/SessionReader.h"
#include "tests/gui/Looks.h"
#include "tests/gui/Person.h"
#include "tests/gui/sessions/WrittenSessions.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class Sessions : public testing::Test {
protected:
    void begin(const QSize& size = {1280, 700}) {
        workspace.resize(size);
        workspace.show();
        EXPECT_IN_TIME(QTest::qWaitForWindowExposed(&workspace));
    }
    [[nodiscard]] QTableView& table() { return *workspace.findChild<QTableView*>("sessionsTable"); }
    [[nodiscard]] QString cell(int row, int column) { return table().model()->index(row, column).data().toString(); }
    void choose(int row) {
        QTest::mouseClick(table().viewport(), Qt::LeftButton, Qt::NoModifier,
                          table().visualRect(table().model()->index(row, 0)).center());
    }
    [[nodiscard]] QLineEdit& field(const char* name) { return *workspace.findChild<QLineEdit*>(name); }
    [[nodiscard]] QString saidOfLabels() { return workspace.findChild<QLabel*>("labelsSaved")->text(); }
    void listed(int count) {
        ASSERT_IN_TIME(comesTrue([&] { return table().model()->rowCount() == count; }));
    }
    void chosen(int row) {
        choose(row);
        ASSERT_IN_TIME(comesTrue([&] { return field("labelOperator").isVisible(); }));
    }
    /// Shows the only session, selected.
    void showOne() {
        begin();
        ASSERT_NO_FATAL_FAILURE(listed(1));
        chosen(0);
    }
    WrittenSessions sessions;
    gui::BenchController controller{simulatedRegistry};
    gui::SessionsWorkspace workspace{controller};
};

TEST_F(Sessions, AColumnThatComesIntoSightIsAsWideAsItsTitle) {
    sessions.write({.name = "a"});
    begin({700, 700});
    listed(1);
    EXPECT_TRUE(table().isColumnHidden(gui::SessionModel::kLength));
    workspace.resize(1800, 900);
    ASSERT_IN_TIME(comesTrue([&] { return !table().isColumnHidden(gui::SessionModel::kLength); }));
    for (int column = 0; column < gui::SessionModel::kNote; ++column)
        EXPECT_GE(table().columnWidth(column), table().horizontalHeader()->sectionSizeHint(column)) << column;
}

TEST_F(Sessions, WhereALongNameLeavesNoRoomForTheNoteItsColumnGoes) {
    (void)sessions.write({.name = "a", .protocol = "stimulator-calibration", .verdict = "indeterminate"});
    gui::applyTextSize(200);
    begin({1200, 640});
    listed(1);
    letLive(100);
    for (const int width : {748, 1200}) {  // 748 is the smallest possible width
        workspace.resize(width, 640);
        EXPECT_IN_TIME(comesTrue([&] { return table().horizontalScrollBar()->maximum() == 0; })) << width;
    }
    EXPECT_FALSE(table().isColumnHidden(gui::SessionModel::kNote)) << "it has room";
}

TEST_F(Sessions, NoWidthMakesAListWithAScrollBarScrollSideways) {
    for (int i = 0; i < 16; ++i)
        (void)sessions.write({.name = std::to_string(i), .protocol = "stimulator-calibration", .verdict = "pass"});
    begin({1000, 440});
    listed(16);
    ASSERT_IN_TIME(comesTrue([&] { return table().verticalScrollBar()->isVisible(); }));
    for (int width = 1000; width > 820; --width) {
        workspace.resize(width, 440);
        EXPECT_IN_TIME(comesTrue([&] { return table().horizontalScrollBar()->maximum() == 0; }, 1000)) << width;
    }
}

TEST_F(Sessions, ACellThatIsTooNarrowSaysAllOfItInItsTip) {
    sessions.write({.name = "a"});
    begin();
    listed(1);
    for (int column = 0; column < gui::SessionModel::kColumns; ++column) {
        const auto index = table().model()->index(0, column);
        const auto tip = index.data(Qt::ToolTipRole).toString();
        EXPECT_TRUE(tip.startsWith(index.data().toString())) << column << ": " << tip.toStdString();
        EXPECT_THAT(tip.toStdString(), HasSubstr("a.tacto")) << "and which session it is";
    }
}

TEST_F(Sessions, FiveThousandAreListedInUnderASecond) {
    // Fifty different sessions under a hundred names each: equal contents do not make the listing any faster.
    constexpr int kDifferent = 50, kNames = 100;
    for (int i = 0; i < kDifferent; ++i) {
        const auto path = sessions.write({.name = fmt::format("run-{:02}-00", i),
                                          .protocol = i % 2 == 0 ? "live" : "load-safety",
                                          .verdict = i % 3 == 0 ? "pass" : "fail",
                                          .wallStart = fmt::format("2026-11-{:02}T10:02:05Z", 1 + i % 28)});
        for (int name = 1; name < kNames; ++name)
            fs::create_hard_link(path, sessions.folder() / fmt::format("run-{:02}-{:02}.tacto", i, name));
    }
    const auto listing = [&] {
        gui::SessionsWorkspace again(controller);
        again.resize(1280, 700);
        QElapsedTimer since;
        since.start();
        again.show();
        auto* rows = again.findChild<QTableView*>("sessionsTable");
        EXPECT_IN_TIME(comesTrue([&] { return rows->model()->rowCount() == kDifferent * kNames; }, 120'000));
        again.repaint();
        return since.elapsed();
    };
    const auto first = listing(), second = listing();
    std::printf("5 000 sessions: %lld ms from the index, %lld ms when each is read\n", static_cast<long long>(second),
                static_cast<long long>(first));
    RecordProperty("listed_ms", int(second));
    RecordProperty("read_ms", int(first));
    EXPECT_IN_TIME(second < 1000);
    EXPECT_LT(second * 2, first) << "the index is what makes it fast";

    begin();
    listed(kDifferent * kNames);
    QElapsedTimer since;
    since.start();
    find<QLineEdit>(workspace, "Search")->setText("fail load");
    const auto searched = since.elapsed();
    std::printf("a search in them: %lld ms\n", static_cast<long long>(searched));
    EXPECT_GT(table().model()->rowCount(), 0);
    EXPECT_LT(table().model()->rowCount(), kDifferent * kNames);
    EXPECT_IN_TIME(searched < 200);
}

TEST_F(Sessions, AreFoundByWhatWasSaidOfThem) {
    const auto path = sessions.write({.name = "a"});
    (void)sessions.write({.name = "b", .protocol = "load-safety", .verdict = "fail"});
    ASSERT_TRUE(saveLabels(path, {}, {"B. Ott", "S-099", "lead was loose", {"P60", "repeat"}}));
    begin();
    listed(2);
    auto* search = find<QLineEdit>(workspace, "Search");
    for (const auto* word : {"separability", "ott", "s-099", "loose", "p60", "REPEAT", "pass", "loose ott"}) {
        search->setText(word);
        ASSERT_EQ(table().model()->rowCount(), 1) << word;
        EXPECT_EQ(cell(0, 2), "Separability") << word;
    }
    search->setText("safety check");
    EXPECT_EQ(table().model()->rowCount(), 1) << "as its workspace is called";
    EXPECT_EQ(cell(0, 2), "Safety check");
    search->setText("load-safety");
    EXPECT_EQ(table().model()->rowCount(), 1) << "as the command line calls it";
    search->clear();
    auto* verdict = find<QComboBox>(workspace, "Verdict");
    verdict->setCurrentText("fail");
    ASSERT_EQ(table().model()->rowCount(), 1);
    EXPECT_EQ(cell(0, 0), "fail");
}

TEST_F(Sessions, AreEditedInPlaceAndKeptInTheSession) {
    RecordProperty("hazard", "H8");
    const auto path = sessions.write({.name = "a"});
    const auto head = SessionReader::open(path)->chainHead();
    ASSERT_NO_FATAL_FAILURE(showOne());
    EXPECT_EQ(field("labelOperator").text(), "A. Weber");
    EXPECT_EQ(field("labelSample").text(), "S-014");
    field("labelNote").setFocus();
    QTest::keyClicks(&field("labelNote"), "table bumped once");
    field("labelTags").setFocus();
    QTest::keyClicks(&field("labelTags"), "P60, P120 ,P60");
    QTest::keyClick(&field("labelTags"), Qt::Key_Return);
    ASSERT_IN_TIME(comesTrue([&] { return saidOfLabels() == "Kept in the session."; })) << saidOfLabels().toStdString();
    const auto kept = SessionReader::open(path)->labels().value();
    EXPECT_EQ(kept, (SessionLabels{"A. Weber", "S-014", "table bumped once", {"P60", "P120"}}));
    EXPECT_EQ(SessionReader::open(path)->chainHead(), head);
    EXPECT_IN_TIME(comesTrue([&] { return cell(0, 6) == "table bumped once #P60 #P120"; })) << cell(0, 6).toStdString();
    EXPECT_EQ(field("labelNote").text(), "table bumped once") << "and stands where it was written";
}

TEST_F(Sessions, ARefusedEditStaysSaidThoughAnotherFollowsAtOnce) {
    RecordProperty("hazard", "H8");
    const auto path = sessions.write({.name = "a"});
    ASSERT_NO_FATAL_FAILURE(showOne());
    field("labelTags").setText(QString(60, 'x'));
    QTest::keyClick(&field("labelTags"), Qt::Key_Return);
    field("labelNote").setText("table bumped once");
    QTest::keyClick(&field("labelNote"), Qt::Key_Return);
    ASSERT_IN_TIME(comesTrue([&] { return SessionReader::open(path)->labels()->note == "table bumped once"; }));
    ASSERT_IN_TIME(comesTrue([&] { return saidOfLabels().contains("60 characters"); })) << saidOfLabels().toStdString();
    const auto* said = dynamic_cast<gui::ElidedLabel*>(workspace.findChild<QLabel*>("labelsSaved"));
    EXPECT_IN_TIME(comesTrue([&] { return said->shownText() == said->text(); })) << "it is read whole";
    EXPECT_GE(field("labelNote").width(), 100);
    shot(workspace, "sessions_refused_label");
    EXPECT_FALSE(comesTrue([&] { return !saidOfLabels().contains("60 characters"); }, 300)) << "nor is it said over";
    EXPECT_EQ(field("labelTags").text(), QString(60, 'x')) << "what is not kept stays to be mended";
    field("labelTags").setText("P60");
    QTest::keyClick(&field("labelTags"), Qt::Key_Return);
    ASSERT_IN_TIME(comesTrue([&] { return saidOfLabels() == "Kept in the session."; })) << saidOfLabels().toStdString();
    EXPECT_EQ(SessionReader::open(path)->labels().value(),
              (SessionLabels{"A. Weber", "S-014", "table bumped once", {"P60"}}));
}

TEST_F(Sessions, ThatWereEditedElsewhereMeanwhileKeepThatAndShowIt) {
    RecordProperty("hazard", "H8");
    const auto path = sessions.write({.name = "a"});
    ASSERT_NO_FATAL_FAILURE(showOne());
    const auto shown = SessionReader::open(path)->labels().value();
    auto elsewhere = shown;
    elsewhere.operatorName = "B. Ott";
    ASSERT_TRUE(saveLabels(path, shown, elsewhere));
    field("labelNote").setText("table bumped once");
    QTest::keyClick(&field("labelNote"), Qt::Key_Return);
    ASSERT_IN_TIME(comesTrue([&] { return saidOfLabels() == "Kept in the session."; })) << saidOfLabels().toStdString();
    EXPECT_EQ(SessionReader::open(path)->labels().value(), (SessionLabels{"B. Ott", "S-014", "table bumped once", {}}));
    EXPECT_EQ(field("labelOperator").text(), "B. Ott");
}

TEST_F(Sessions, ThatAreReadOnlySayWhyAndTakeNoEdit) {
    const auto path = sessions.write({.name = "a"});
    fs::permissions(path, fs::perms::owner_read);
    ASSERT_NO_FATAL_FAILURE(showOne());
    EXPECT_TRUE(field("labelNote").isReadOnly());
    EXPECT_THAT(saidOfLabels().toStdString(), HasSubstr("a.tacto is read-only"));
    EXPECT_THAT(field("labelNote").toolTip().toStdString(), HasSubstr("read-only"));
    fs::permissions(path, fs::perms::owner_all);
}

TEST_F(Sessions, WhatAnIndexSaysWrongIsCorrectedBeforeItIsReadTwice) {
    RecordProperty("hazard", "H9");
    const auto path = sessions.write({.name = "a", .verdict = "fail"});
    begin();
    listed(1);
    ASSERT_EQ(cell(0, 0), "fail");
    workspace.hide();
    // A false entry that looks right: as if the session's verdict were "pass".
    const auto file =
        fs::path(QDir(qEnvironmentVariable("XDG_CACHE_HOME")).filePath("tactoscope/sessions.index").toStdString());
    sqlite3* database = nullptr;
    sqlite3_stmt* row = nullptr;
    ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
    ASSERT_EQ(sqlite3_prepare_v2(database, "SELECT stamp, body FROM summaries", -1, &row, nullptr), SQLITE_OK);
    ASSERT_EQ(sqlite3_step(row), SQLITE_ROW);
    const auto text = [&](int column) {
        return std::string(reinterpret_cast<const char*>(sqlite3_column_text(row, column)));
    };
    const auto stamp = text(0);
    auto body = text(1);
    sqlite3_finalize(row);
    const auto at = body.find("\"fail\"");
    ASSERT_NE(at, std::string::npos);
    body.replace(at, 6, "\"pass\"");
    const auto lie = fmt::format("UPDATE summaries SET body='{}', checked='{}'", body,
                                 sha256Hex(path.string() + "\n" + stamp + "\n" + body));
    ASSERT_EQ(sqlite3_exec(database, lie.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(database);

    gui::SessionsWorkspace again(controller);
    again.resize(1280, 700);
    again.show();
    auto* rows = again.findChild<QTableView*>("sessionsTable");
    ASSERT_IN_TIME(comesTrue([&] { return rows->model()->rowCount() == 1; }));
    EXPECT_IN_TIME(comesTrue([&] { return rows->model()->index(0, 0).data() == "fail"; })) << "what is seen is read";
}

TEST_F(Sessions, AChoiceIsSaidInTheWordsOfItsProtocol) {
    (void)sessions.write({.name = "a"});
    ASSERT_NO_FATAL_FAILURE(showOne());
    const QTextBrowser* about = nullptr;
    for (const auto* browser : workspace.findChildren<QTextBrowser*>())
        if (browser->accessibleName() == "About the session") about = browser;
    ASSERT_NE(about, nullptr);
    const auto says = about->toPlainText();
    EXPECT_THAT(says.toStdString(), HasSubstr("Sample rate"));
    EXPECT_THAT(says.toStdString(), HasSubstr("1 MS/s"));
    EXPECT_THAT(says.toStdString(), Not(HasSubstr("1M")));
    EXPECT_THAT(says.toStdString(), HasSubstr("yes")) << "keep, which no declaration names";
    EXPECT_THAT(says.toStdString(), HasSubstr("Stimulator"));
    EXPECT_THAT(says.toStdString(), HasSubstr("Separability: ✔ pass\n98 of 100 told apart."));
    const auto began = QDateTime::fromString("2026-11-20T10:02:05Z", Qt::ISODate).toLocalTime();
    EXPECT_THAT(says.toStdString(), HasSubstr(gui::beganText(began).toStdString()));
    EXPECT_THAT(says.toStdString(), Not(HasSubstr("T10:02"))) << "as the list says it";
    EXPECT_THAT(says.toStdString(), HasSubstr("rows 3, steps (5 V, 10 V)"));
    EXPECT_THAT(says.toStdString(), Not(HasSubstr("{")));
    shot(workspace, "sessions-about");
}

TEST_F(Sessions, ThePreviewKeepsItsHeightInALowWindow) {
    (void)sessions.write({.name = "a"});
    ASSERT_NO_FATAL_FAILURE(showOne());
    workspace.resize(1180, 600);
    const auto* plane = workspace.findChild<gui::TrialPlane*>();
    ASSERT_IN_TIME(comesTrue([&] { return plane->isVisible() && workspace.height() <= 610; })) << workspace.height();
    EXPECT_IN_TIME(comesTrue([&] { return plane->axisRect()->height() >= 140; })) << plane->axisRect()->height();
    EXPECT_EQ(plane->legend->wrap(), 0) << "four names in one row";
}

TEST_F(Sessions, LooksRight) {
    (void)sessions.write({.name = "a", .protocol = "load-safety", .wallStart = "2026-11-19T17:44:00Z"});
    (void)sessions.write({.name = "b", .protocol = "stimulator-calibration", .verdict = "stopped"});
    (void)sessions.write({.name = "c", .protocol = "", .verdict = "", .wallStart = "2026-11-21T08:10:00Z"});
    const auto path = sessions.write({.name = "d", .verdict = "indeterminate", .wallStart = "2026-11-22T09:31:00Z"});
    ASSERT_TRUE(
        saveLabels(path, {}, {"A. Weber", "S-014", "P60 against P120, table bumped once; repeat with 40", {"P60"}}));
    begin();
    listed(4);
    ASSERT_NO_FATAL_FAILURE(chosen(0));
    for (const auto theme : {gui::Theme::Light, gui::Theme::Dark}) {
        gui::applyTheme(theme);
        for (const auto& size : {QSize(1180, 560), QSize(1800, 900)}) {
            workspace.resize(size);
            letLive(200);
            shot(workspace,
                 QString("sessions-%1-%2").arg(theme == gui::Theme::Dark ? "dark" : "light").arg(size.width()));
            EXPECT_EQ(faultsOf(workspace), "") << size.width();
        }
    }
    gui::applyTheme(gui::Theme::Light);
    choose(1);
    letLive(300);
    shot(workspace, "sessions-live");
}

}  // namespace
}  // namespace tacto::test
