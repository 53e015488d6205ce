// Runs every shipped protocol and tests that the tables of its result show no internal key.
#include <QClipboard>
#include <QFormLayout>
#include <QHeaderView>
#include <QPushButton>
#include <QScrollArea>
#include <QTableWidget>
#include <QTreeWidget>
#include <gmock/gmock.h>
#include <set>

#include "app/gui/runner/NextSteps.h"
#include "app/gui/runner/ResultTables.h"
#include "tests/gui/Looks.h"
#include "tests/gui/runner/Lab.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using gui::NextStep;
using testing::ElementsAre;
using testing::HasSubstr;

/// The texts that a reader sees in the tables: headers, cells, words.
std::vector<QString> textsIn(const gui::ResultTables& tables) {
    std::vector<QString> texts;
    for (const auto* table : tables.findChildren<QTableWidget*>()) {
        for (int c = 0; c < table->columnCount(); ++c) {
            texts.push_back(table->horizontalHeaderItem(c)->text());
            for (int r = 0; r < table->rowCount(); ++r)
                if (table->item(r, c) != nullptr) texts.push_back(table->item(r, c)->text());
        }
    }
    for (const auto* label : tables.findChildren<QLabel*>()) texts.push_back(label->text());
    return texts;
}

bool looksLikeAKey(const QString& text) {
    static const QRegularExpression key("[a-z0-9]_[a-z0-9]", QRegularExpression::CaseInsensitiveOption);
    return key.match(text).hasMatch();
}

class Results : public Lab, public testing::WithParamInterface<const char*> {};

TEST_P(Results, ShowNoKeyAndNeedNoScrollingSideways) {
    open("", {1150, 600});  // the workspace in a window of 1280 x 720
    choose(GetParam());
    type("devices", "sim:");  // after this the form exists
    const std::pair<const char*, const char*> quick[] = {{"area", "4"},   {"steps", "2"},   {"warm_up_s", "0"},
                                                         {"levels", "3"}, {"repeats", "2"}, {"participants", "20"}};
    for (const auto& [field, text] : quick) {
        if (workspace->findChild<QLineEdit*>(field) != nullptr) workspace->propose(field, text);
    }
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    click(the<QPushButton>("runButton"));
    ASSERT_IN_TIME(ends(120'000));
    ASSERT_FALSE(ended->result.outcome.error) << ended->result.outcome.error->message;
    click(the<QPushButton>("Tables"));
    auto& tables = the<gui::ResultTables>("resultTables");
    ASSERT_FALSE(tables.empty());
    shot(*workspace, QString("tables_%1").arg(GetParam()));
    EXPECT_TRUE(tables.findChildren<QTreeWidget*>().isEmpty());
    for (const auto* form : tables.findChildren<QFormLayout*>()) {  // facts are copied with a row for each
        auto* value = form->itemAt(0, QFormLayout::FieldRole)->widget();
        QTest::keyClick(value, Qt::Key_C, Qt::ControlModifier);
        const auto copied = QGuiApplication::clipboard()->text();
        EXPECT_GT(copied.count('\n'), form->rowCount()) << copied.toStdString();
        EXPECT_TRUE(copied.contains(
            qobject_cast<const QLabel*>(form->itemAt(0, QFormLayout::LabelRole)->widget())->text().simplified()))
            << copied.toStdString();
    }
    const auto texts = textsIn(tables);
    EXPECT_GT(texts.size(), 5U);
    for (const auto& text : texts) EXPECT_FALSE(looksLikeAKey(text)) << text.toStdString();
    for (const auto* table : tables.findChildren<QTableWidget*>()) {
        EXPECT_LE(table->horizontalHeader()->length(), table->viewport()->width())
            << table->accessibleName().toStdString();
    }
    EXPECT_LE(tables.minimumSizeHint().width(), tables.parentWidget()->width());
}

INSTANTIATE_TEST_SUITE_P(Shipped, Results,
                         testing::Values("encoding-comparison", "live", "load-safety", "massager", "sensor-calibration",
                                         "separability", "stimulator-calibration", "transitions", "variation"),
                         [](const auto& one) { return QString(one.param).replace('-', '_').toStdString(); });

TEST(ResultTables, OfALabsOwnKindHaveTheWordsOfTheirKeysAndNoTree) {
    gui::ResultTables tables;
    tables.show({{"verdict", "pass"},
                 {"peak_ma", 3.5},
                 {"deep", {{"inside_v", {{"more", 1}}}}},
                 {"readings", nlohmann::json::array({{{"load_ohm", 500}, {"name", "first"}}})}});
    const auto* table = tables.findChild<QTableWidget*>();
    ASSERT_NE(table, nullptr);
    EXPECT_EQ(table->horizontalHeaderItem(0)->text(), "Name");
    EXPECT_EQ(table->horizontalHeaderItem(1)->text(), "Load\n(Ω)");
    for (const auto& text : textsIn(tables)) EXPECT_FALSE(looksLikeAKey(text)) << text.toStdString();
    EXPECT_TRUE(tables.findChildren<QTreeWidget*>().isEmpty());
}

TEST(ResultTables, OfAReferenceSayItsVerdictAsShapeAndWord) {
    RecordProperty("hazard", "H9");
    const auto of = [](const char* kind, const char* check, const nlohmann::json& found) {
        gui::ResultTables tables;
        tables.show({{"kind", kind}, {check, found}});
        QStringList texts;
        for (const auto& text : textsIn(tables)) texts << text;
        return texts;
    };
    using testing::Contains;
    const auto load = [&](bool passed, const char* verdict) {
        return of("stimulator-calibration", "reference",
                  {{"load_ohm", 1000}, {"passed", passed}, {"verdict", verdict}});
    };
    EXPECT_THAT(load(true, "pass"), Contains(QString("✔ pass")));
    EXPECT_THAT(load(false, "fail"), Contains(QString("✖ fail")));
    EXPECT_THAT(load(false, "indeterminate"), Contains(QString("? indeterminate")));
    EXPECT_THAT(load(false, "indeterminate"), testing::Not(Contains(QString("✖ fail")))) << "unknown is not a failure";
    EXPECT_THAT(of("sensor-calibration", "reference", {{"mass_g", 100}, {"passed", true}, {"verdict", "pass"}}),
                Contains(QString("✔ pass")));
    const auto unknown = of("load-safety", "absolute", {{"passed", false}, {"verdict", "not evaluated"}});
    EXPECT_THAT(unknown, Contains(QString("○ not evaluated"))) << "and not that it failed";
    EXPECT_THAT(unknown, testing::Not(Contains(QString("✖ fail"))));
}

gui::FinishedRun finished(const nlohmann::json& results, ScriptVerdict verdict) {
    gui::FinishedRun run;
    run.result.outcome.results = results;
    run.result.outcome.verdict = verdict;
    run.result.session = "/lab/run.tacto";
    return run;
}

TEST(NextSteps, FollowFromWhatWasFound) {
    const auto pass = ScriptVerdict::Pass;
    EXPECT_THAT(gui::nextStepsAfter(
                    finished({{"kind", "sensor-calibration"}, {"profile", {{"profile", {{"name", "x"}}}}}}, pass)),
                ElementsAre(NextStep::UseProfile, NextStep::Sign, NextStep::Report, NextStep::Session));
    EXPECT_THAT(
        gui::nextStepsAfter(finished({{"kind", "stimulator-calibration"}, {"stored", {{"serial", "S"}}}}, pass)),
        ElementsAre(NextStep::Sign, NextStep::Report, NextStep::SafetyCheck, NextStep::Check, NextStep::Session));
    const nlohmann::json check = {{"kind", "stimulator-calibration"}, {"type", "check"}};
    EXPECT_THAT(gui::nextStepsAfter(finished(check, ScriptVerdict::Fail)),
                ElementsAre(NextStep::Calibrate, NextStep::Sign, NextStep::Report, NextStep::Session));
    EXPECT_THAT(gui::nextStepsAfter(finished({{"kind", "load-safety"}}, pass)),
                ElementsAre(NextStep::Sign, NextStep::Report, NextStep::Live, NextStep::Session));
    EXPECT_THAT(gui::nextStepsAfter(finished({{"kind", "load-safety"}}, ScriptVerdict::Indeterminate)),
                ElementsAre(NextStep::ChangeSettings, NextStep::Sign, NextStep::Report, NextStep::Session));
    EXPECT_THAT(gui::nextStepsAfter(finished({{"kind", "live"}}, ScriptVerdict::None)),
                ElementsAre(NextStep::Sign, NextStep::Report, NextStep::Session));
}

TEST(NextSteps, AfterAFaultTheWayBackComesFirst) {
    RecordProperty("hazard", "H12");
    auto run = finished({{"kind", "load-safety"}}, ScriptVerdict::None);
    run.result.outcome.error = Error{ErrorCode::Device, "the stimulator is unplugged"};
    run.result.stoppedBySafety = true;
    run.result.leftIn = LeftFault{"sciencemode P24-0017", "the stimulator is unplugged"};
    run.order.uris = {*DeviceUri::parse("sciencemode:"), *DeviceUri::parse("capture:/a?fault=open")};
    EXPECT_THAT(gui::nextStepsAfter(run),
                ElementsAre(NextStep::ResetFault, NextStep::ChangeSettings, NextStep::Report, NextStep::Session));
    run.order.uris = {*DeviceUri::parse("sim:finger"), *DeviceUri::parse("sim:stimulator?gain=1&fault=open@3s")};
    EXPECT_EQ(gui::nextStepsAfter(run).front(), NextStep::WithoutFault);
    run.order.uris = {*DeviceUri::parse("sciencemode:")};
    run.result.leftIn->causes = bitOf(FaultCause::LimitBroken);
    run.order.declaration.kind = "stimulator-calibration";
    EXPECT_EQ(gui::nextStepsAfter(run).front(), NextStep::SafetyCheck) << "not the run again";
    EXPECT_EQ(std::ranges::count(gui::nextStepsAfter(run), NextStep::ResetFault), 0);
    run.order.declaration.kind = "load-safety";
    EXPECT_EQ(gui::nextStepsAfter(run).front(), NextStep::ResetFault) << "the check itself";
    run.result.stoppedBySafety = false;
    run.result.leftIn.reset();
    EXPECT_EQ(gui::nextStepsAfter(run).front(), NextStep::ChangeSettings) << "a mistake in a script";
}

TEST(NextSteps, StandInRowsWhereOneHasNoRoom) {
    gui::NextStepBar bar;
    bar.show({NextStep::Sign, NextStep::SafetyCheck, NextStep::Check, NextStep::Session});
    static_cast<QWidget&>(bar).show();
    bar.resize(bar.sizeHint().width(), 60);
    const auto rows = [&] {
        std::set<int> tops;
        for (const auto* button : bar.findChildren<QPushButton*>()) {
            EXPECT_TRUE(bar.rect().contains(button->geometry())) << button->text().toStdString();
            tops.insert(button->y());
        }
        return tops.size();
    };
    EXPECT_EQ(rows(), 1U);
    EXPECT_LT(bar.minimumSizeHint().width(), bar.width() / 2);
    bar.resize(bar.sizeHint().width() / 2, 120);
    EXPECT_GE(rows(), 2U);
    EXPECT_EQ(cutTexts(bar).join('\n').toStdString(), "");
}

TEST(NextSteps, AProfileOfAResultThatDidNotPassIsNotOffered) {
    RecordProperty("hazard", "H9");
    auto run =
        finished({{"kind", "sensor-calibration"}, {"profile", {{"profile", {{"name", "x"}}}}}}, ScriptVerdict::Fail);
    EXPECT_THAT(gui::nextStepsAfter(run), testing::Not(testing::Contains(NextStep::UseProfile)));
    run.result.outcome.verdict = ScriptVerdict::Stopped;
    run.result.outcome.error = Error{ErrorCode::Stopped, "stopped"};
    run.result.session.clear();
    EXPECT_THAT(gui::nextStepsAfter(run), ElementsAre(NextStep::ChangeSettings));
}

}  // namespace
}  // namespace tacto::test
