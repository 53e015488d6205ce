// The time to make a report; under sanitizers it may take longer.
#include <QElapsedTimer>
#include <gtest/gtest.h>

#include "app/report/Report.h"
#include "tests/report/Samples.h"
#include "tests/support/InTime.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

qint64 millisecondsToWrite(const ReportModel& model) {
    const ScratchDir folder;
    QElapsedTimer timer;
    timer.start();
    for (const char* name : {"r.pdf", "r.html"}) {
        const auto written = writeReport(model, QString::fromStdString((folder.path() / name).string()));
        EXPECT_TRUE(written) << (written ? "" : written.error().message);
    }
    return timer.elapsed();
}

TEST(ReportTime, APdfAndAnHtmlReportTakeLessThanTwoSeconds) {
    const auto took = millisecondsToWrite(separabilityModel(true));
    RecordProperty("milliseconds", static_cast<int>(took));
    EXPECT_IN_TIME(took < 2000) << took << " ms";
}

TEST(ReportTime, TextsWithoutEndTakeLessThanFiveSeconds) {
    RecordProperty("hazard", "H10");
    const QString text(900'000, 'm');
    auto model = separabilityModel(true, 3);
    model.title = model.purpose = text;
    model.reasons << text;
    model.items.emplace_back(ReportText{text});
    model.items.emplace_back(ReportTable{text, {}, {QJsonObject{{"name", text}, {text, 1}}}});
    model.events.push_back({1, "remark", text, 1});
    const auto took = millisecondsToWrite(model);
    RecordProperty("milliseconds", static_cast<int>(took));
    EXPECT_IN_TIME(took < 5000) << took << " ms";
}

}  // namespace
}  // namespace tacto::test
