#include <QJsonDocument>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/report/Report.h"
#include "app/report/SessionReport.h"
#include "core/session/SessionLabels.h"
#include "core/session/SessionWriter.h"
#include "tests/report/Samples.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

nlohmann::json toJson(const QJsonObject& object) {
    return nlohmann::json::parse(QJsonDocument(object).toJson(QJsonDocument::Compact).toStdString());
}

class SessionReport : public ::testing::Test {
protected:
    void SetUp() override {
        SessionAbout about;
        about.programVersion = "0.1.0";
        about.protocol = "separability";
        about.protocolSha256 = std::string(64, 'a');
        about.parameters = {{"repeats", 25}, {"source", "finger"}, {"note", "two words"}};
        about.seed = 7;
        about.devices = {{"sim:", "stimulator", "Simulated stimulator", "SIM-0001", "1", true},
                         {"sim:", "oscilloscope", "Simulated oscilloscope", "SIM-0002", "1", true}};
        about.limitSets = {{"paper", std::string(64, 'c')}};
        about.simulated = true;
        about.wallStart = "2026-11-20T14:03:05Z";
        about.profileJson = R"({"safety": {"electrode_area_cm2": 4.5},
                                "electrode": {"name": "TENS 40", "material": "", "medium": "hydrogel"}})";
        writer_ = accepted(SessionWriter::create(path_, about, clock_));
    }

    ReportModel closedAndRead() {
        EXPECT_TRUE(writer_->close());
        return read();
    }
    ReportModel read() {
        auto model = readSessionReport(path_);
        EXPECT_TRUE(model) << (model ? "" : model.error().message);
        return model ? *model : ReportModel{};
    }

    ScratchDir scratch_;
    std::filesystem::path path_ = scratch_.path() / "run-7.tacto";
    VirtualClock clock_;
    std::unique_ptr<SessionWriter> writer_;
};

TEST_F(SessionReport, SaysWhatWasUsed) {
    const auto head = [&] {
        EXPECT_TRUE(writer_->close());
        return writer_->chainHead();
    }();
    const auto model = read();
    EXPECT_EQ(model.session, "run-7");
    EXPECT_EQ(model.chainHead.toStdString(), head);
    EXPECT_EQ(model.devices.size(), 2U);
    EXPECT_TRUE(model.simulated);
    const auto electrode =
        std::ranges::find(model.identity, QString("Electrode"), [](const auto& row) { return row.name; });
    ASSERT_NE(electrode, model.identity.end());
    EXPECT_EQ(electrode->value.toStdString(), "TENS 40, 4.5\u202fcm², hydrogel");
    ASSERT_EQ(model.reproduce.size(), 2);
    EXPECT_EQ(
        model.reproduce[0].toStdString(),
        "tactoscope-cli run separability --device sim: --set 'note=two words' --set repeats=25 --set source=finger "
        "--seed 7");
    EXPECT_EQ(model.reproduce[1], "tactoscope-cli verify run-7.tacto");
}

TEST_F(SessionReport, TakesItemsInTheScriptsOrder) {
    ASSERT_TRUE(
        writer_->reportItem(Instant{0}, {{"kind", "about"}, {"title", "Signal separability"}, {"purpose", "Why?"}}));
    ASSERT_TRUE(writer_->reportItem(Instant{0}, {{"kind", "text"}, {"text", "First."}}));
    ASSERT_TRUE(
        writer_->reportItem(Instant{0}, {{"kind", "figure"}, {"caption", "Plane"}, {"figure", toJson(planeJson(3))}}));
    ASSERT_TRUE(writer_->reportItem(
        Instant{0},
        {{"kind", "table"}, {"caption", "Pairs"}, {"rows", nlohmann::json::array({{{"a", "x"}, {"n", 3}}})}}));
    const auto model = closedAndRead();
    EXPECT_EQ(model.title, "Signal separability");
    ASSERT_EQ(model.items.size(), 3U);
    EXPECT_EQ(std::get<ReportText>(model.items[0]).text, "First.");
    EXPECT_EQ(std::get<ReportFigure>(model.items[1]).caption, "Plane");
    EXPECT_EQ(std::get<ReportTable>(model.items[2]).rows.size(), 1);
}

TEST_F(SessionReport, StatesTheRuleOfTheKindThatTheProtocolDeclares) {
    RecordProperty("hazard", "H9");
    ASSERT_TRUE(writer_->reportItem(Instant{0}, {{"kind", "about"}, {"title", "x"}, {"result_kind", "load-safety"}}));
    const auto model = closedAndRead();
    ASSERT_EQ(model.basis.rule.size(), 3U) << "and its guard band and coverage";
    EXPECT_TRUE(model.basis.rule[0].value.startsWith("Each value passes when value + U keeps its limit"));
}

TEST_F(SessionReport, OfASessionFromBeforeKindsWereDeclaredStatesTheRuleOfItsProtocol) {
    RecordProperty("hazard", "H9");
    ASSERT_TRUE(writer_->reportItem(Instant{0}, {{"kind", "about"}, {"title", "Signal separability"}}));
    const auto model = closedAndRead();
    ASSERT_EQ(model.basis.rule.size(), 1U);
    EXPECT_TRUE(model.basis.rule[0].value.startsWith("Separable when each pair of conditions"));
}

TEST_F(SessionReport, GivesAChoiceInItsProtocolsWordsAndAKeepAliveItsTime) {
    ASSERT_TRUE(writer_->reportItem(
        Instant{0},
        {{"kind", "about"},
         {"title", "x"},
         {"parameters",
          {{{"name", "rate"}, {"label", "Sampling rate"}, {"value", "1M"}, {"shown", "1 MS/s"}},
           {{"name", "area"}, {"label", "Area"}, {"value", 0}, {"unit", "cm2"}, {"shown", "from the profile"}}}}}));
    ASSERT_TRUE(writer_->event(toInstant(1), "keep-alive", {{"longest_gap_s", 0.25}, {"text", "the longest time"}}));
    const auto model = closedAndRead();
    ASSERT_EQ(model.settings.size(), 2U);
    EXPECT_EQ(model.settings[0].value, "1 MS/s");
    EXPECT_EQ(model.settings[1].value, "from the profile") << "what 0 stands for";
    ASSERT_EQ(model.events.size(), 1U);
    EXPECT_EQ(model.events[0].text, "the longest time: 250\u202fms");
}

TEST_F(SessionReport, ShowsABrokenFigureAsASentence) {
    ASSERT_TRUE(
        writer_->reportItem(Instant{0}, {{"kind", "figure"}, {"caption", "Pie"}, {"figure", {{"type", "pie"}}}}));
    const auto model = closedAndRead();
    ASSERT_EQ(model.items.size(), 1U);
    EXPECT_TRUE(std::get<ReportText>(model.items[0]).text.startsWith("The figure “Pie” could not be drawn:"));
}

TEST_F(SessionReport, FindsCapturesOfTheSession) {
    Capture capture;
    capture.rate_hz = 1e6;
    capture.simulated = true;
    capture.channels = {{"voltage", "V", {0, 1, 2, 1, 0}}};
    const auto seq = writer_->capture(Instant{0}, capture);
    ASSERT_TRUE(seq);
    const nlohmann::json figure{{"type", "waveforms"}, {"captures", nlohmann::json::array({{{"capture", *seq}}})}};
    ASSERT_TRUE(writer_->reportItem(Instant{0}, {{"kind", "figure"}, {"caption", "Pulses"}, {"figure", figure}}));
    const auto model = closedAndRead();
    ASSERT_TRUE(std::holds_alternative<ReportFigure>(model.items.at(0)));
    const auto& content = std::get<ReportFigure>(model.items[0]).figure.content;
    EXPECT_EQ(std::get<WaveformsFigure>(content).captures[0].voltage_v, (std::vector<double>{0, 1, 2, 1, 0}));
}

TEST_F(SessionReport, TakesTheLastVerdict) {
    ASSERT_TRUE(writer_->verdict(Instant{0}, "wiring", "fail", {"A first try."}, {}));
    ASSERT_TRUE(writer_->verdict(Instant{0}, "separability", "pass", {"All pairs apart."}, {}));
    const auto model = closedAndRead();
    EXPECT_EQ(model.verdict, ReportVerdict::Pass);
    EXPECT_EQ(model.reasons, QStringList{"All pairs apart."});
}

TEST_F(SessionReport, NeverCallsABrokenOffSessionPassed) {
    RecordProperty("hazard", "H9");
    ASSERT_TRUE(writer_->verdict(Instant{0}, "separability", "pass", {"All pairs apart."}, {}));
    const auto model = read();  // the session is still open
    EXPECT_EQ(model.verdict, ReportVerdict::Stopped);
    EXPECT_TRUE(model.reasons.first().startsWith("The session was not closed"));
}

TEST_F(SessionReport, SaysStoppedWhereAStopEndedIt) {
    ASSERT_TRUE(writer_->event(toInstant(1.5), "stop", {{"text", "Stopped by the operator."}}));
    const auto model = closedAndRead();
    EXPECT_EQ(model.verdict, ReportVerdict::Stopped);
    EXPECT_EQ(model.reasons, QStringList{"Stopped by the operator."});
}

TEST_F(SessionReport, SaysStoppedWhereTheScriptEndedByAnError) {
    RecordProperty("hazard", "H9");
    ASSERT_TRUE(
        writer_->event(toInstant(1.5), "script ended by an error", {{"message", "separability.js:12: no trains"}}));
    const auto model = closedAndRead();
    EXPECT_EQ(model.verdict, ReportVerdict::Stopped);
    EXPECT_EQ(model.reasons, QStringList{"separability.js:12: no trains"});
}

TEST_F(SessionReport, OnlyWhatTheProgramRecordedStandsUnderExposureAgainstLimits) {
    RecordProperty("hazard", "H9");
    const auto row = [](double value) {
        return nlohmann::json{{"name", "RMS"}, {"value", value}, {"limit", 10}, {"unit", "mA"}, {"source", "paper"}};
    };
    const auto figure = [&](const char* caption, const nlohmann::json& rows) {
        const nlohmann::json exposure{{"type", "exposure"}, {"rows", rows}};
        ASSERT_TRUE(writer_->reportItem(Instant{0}, {{"kind", "figure"}, {"caption", caption}, {"figure", exposure}}));
    };
    figure("as the program says", nlohmann::json::array({row(2)}));
    figure("more than it says", nlohmann::json::array({row(3.5)}));
    auto other = row(1);
    other["name"] = "Charge";
    figure("something else", nlohmann::json::array({row(1), other}));
    figure("broken", nlohmann::json::array({5}));
    ASSERT_TRUE(writer_->measurement(Instant{0}, kExposureMeasurement, {{"rows", nlohmann::json::array({row(3)})}}));
    const auto model = closedAndRead();
    ASSERT_EQ(model.exposure.size(), 1U);
    EXPECT_DOUBLE_EQ(model.exposure[0].value, 3);
    ASSERT_EQ(model.items.size(), 3U);
    EXPECT_EQ(std::get<ReportFigure>(model.items[0]).caption, "more than it says (computed from approved trains)");
    EXPECT_EQ(std::get<ReportFigure>(model.items[1]).caption, "something else (computed from approved trains)");
    EXPECT_TRUE(std::get<ReportText>(model.items[2]).text.contains("“broken” could not be drawn"));
}

TEST_F(SessionReport, ListsFaultsAndRefusalsButNotTheQuietEvents) {
    ASSERT_TRUE(writer_->event(toInstant(1), "armed", {}));
    for (int i = 0; i < 3; ++i) {
        ASSERT_TRUE(writer_->event(toInstant(2 + i), "refused", {{"text", "Peak current over the limit."}}));
    }
    ASSERT_TRUE(writer_->event(toInstant(9), "fault", {{"reason", "electrode open"}}));
    const auto model = closedAndRead();
    ASSERT_EQ(model.events.size(), 2U);
    EXPECT_EQ(model.events[0].count, 3);
    EXPECT_EQ(model.events[1].text, "electrode open");
}

TEST_F(SessionReport, ListsEachMarkOfTheOperator) {
    for (const double at : {1.0, 2.0})
        ASSERT_TRUE(writer_->event(toInstant(at), kOperatorMarkEvent, {{"text", "table bumped"}}));
    const auto model = closedAndRead();
    ASSERT_EQ(model.events.size(), 2U);
    EXPECT_EQ(model.events[1].t_s, 2.0);
    EXPECT_EQ(model.events[1].text, "table bumped");
}

TEST_F(SessionReport, TellsWhatWasSaidAfterwardsFromWhatWasEnteredBefore) {
    RecordProperty("hazard", "H8");
    ASSERT_TRUE(writer_->reportItem(clock_.now(), {{"kind", "notes"}, {"operator", "A. Weber"}, {"sample", "S-1"}}));
    const auto before = closedAndRead();
    EXPECT_EQ(before.basis.operatorName, "A. Weber");
    EXPECT_EQ(before.basis.sample, "S-1");
    ASSERT_TRUE(saveLabels(path_, {}, {"A. Weber", "S-2", "the wrong load", {"P60", "repeat"}}));
    const auto model = read();
    EXPECT_EQ(model.basis.operatorName, "A. Weber");
    EXPECT_EQ(model.basis.sample, "S-2 (entered after the recording ended)");
    EXPECT_EQ(model.basis.note, "the wrong load");
    EXPECT_EQ(model.basis.tags, "P60, repeat");
    EXPECT_EQ(model.chainHead, before.chainHead);
    EXPECT_TRUE(model.damage.isEmpty());
    EXPECT_EQ(model.verdict, before.verdict) << "it is still a session that was closed";
}

TEST_F(SessionReport, ShowsTheWorstExposureAndNotEvaluatedAboveAnyNumber) {
    RecordProperty("hazard", "H9");
    const auto rows = [](nlohmann::json current, nlohmann::json density) {
        return nlohmann::json{
            {"rows",
             nlohmann::json::array(
                 {{{"name", "RMS"}, {"value", current}, {"limit", 10}, {"unit", "mA"}, {"source", "paper"}},
                  {{"name", "Density"}, {"value", density}, {"limit", 2}, {"unit", "mA/cm2"}, {"source", "x"}}})}};
    };
    ASSERT_TRUE(writer_->measurement(Instant{0}, kExposureMeasurement, rows(1.0, 0.5)));
    ASSERT_TRUE(writer_->measurement(Instant{0}, kExposureMeasurement, rows(3.0, nullptr)));
    ASSERT_TRUE(writer_->measurement(Instant{0}, kExposureMeasurement, rows(2.0, 0.5)));
    const auto model = closedAndRead();
    ASSERT_EQ(model.exposure.size(), 2U);
    EXPECT_DOUBLE_EQ(model.exposure[0].value, 3.0);
    EXPECT_TRUE(std::isnan(model.exposure[1].value));
}

TEST_F(SessionReport, IsMadeFromTheSessionAlone) {
    ASSERT_TRUE(
        writer_->reportItem(Instant{0}, {{"kind", "figure"}, {"caption", "Plane"}, {"figure", toJson(planeJson(3))}}));
    ASSERT_TRUE(writer_->verdict(Instant{0}, "separability", "pass", {"All pairs apart."}, {}));
    ASSERT_TRUE(writer_->close());
    const auto html = scratch_.path() / "run.html";
    accepted(writeSessionReport(QString::fromStdString(path_.string()), {QString::fromStdString(html.string())}));
    EXPECT_TRUE(contentOfFile(html).contains("All pairs apart."));
    EXPECT_TRUE(contentOfFile(html).contains(QByteArray::fromStdString(writer_->chainHead())));
}

TEST_F(SessionReport, RefusesWhatIsNotASession) {
    EXPECT_THAT(readSessionReport(scratch_.path() / "none.tacto"), refused(ErrorCode::NotFound));
    EXPECT_THAT(readSessionReport(scratch_.write("notes.tacto", "not a session")), refused(ErrorCode::Unsupported));
}

}  // namespace
}  // namespace tacto::test
