// Tests pictures and data that the oscilloscope saves as files.
#include <QFile>
#include <QImage>
#include <QTemporaryDir>
#include <QTimeZone>
#include <gmock/gmock.h>

#include "app/gui/scope/measurements/Reading.h"
#include "app/gui/scope/model/CapturePipe.h"
#include "app/gui/scope/screen/ScopePicture.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Theme.h"
#include "core/formats/csv/CsvFormat.h"
#include "core/measure/CaptureFile.h"
#include "tests/gui/scope/Captures.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class Exports : public testing::Test {
protected:
    Exports() {
        screen.resize(900, 500);
        screen.QWidget::show();
        gui::MathOptions math;
        math.power = true;
        model.show(prepared(twoPulses(), math));
    }
    QByteArray bytes(const QString& path) {
        QFile file(path);
        return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
    }
    QTemporaryDir folder;
    gui::ScopeModel model;
    gui::ScopeScreen screen{model};
};

TEST_F(Exports, APictureSaysWhatItShows) {
    auto averaged = std::make_shared<gui::ShownCapture>(*model.shown());
    averaged->averaged = 16;
    model.show(averaged);
    gui::PictureCaption caption{"Oscilloscope · simulated", "2026-11-23 19:00:00", {}};
    caption.lines << "simulated oscilloscope SIM-1" << gui::scalesText(model) << QString() << "V:  Amplitude 40.0 V";
    const auto path = folder.filePath("said.svg");
    const auto still = stillOf(model, screen, caption);
    ASSERT_EQ(gui::saveScopePicture(still, path), std::nullopt);
    const auto drawing = QString::fromUtf8(bytes(path));
    for (const auto* text :
         {"Oscilloscope · simulated", "2026-11-23 19:00:00", "simulated oscilloscope SIM-1", "V/div", "1\u202fms/div",
          "20\u202f000 samples at 2\u202fMS/s", "averaged 16", "Amplitude 40.0 V", "SIMULATED", "Voltage (V)"}) {
        EXPECT_TRUE(drawing.contains(text)) << text;
    }
    const auto picture = gui::scopePicture(still);
    EXPECT_EQ(picture.width(), 2 * (screen.width() + 2 * gui::PictureCaption::kMargin));
    EXPECT_GT(picture.height(), 2 * (screen.height() + gui::PictureCaption::kMargin) + 100)
        << "the caption takes nothing from the plot";
}

TEST_F(Exports, APictureIsOfTheMomentThatItWasAskedForAndSaysWhenWithItsZone) {
    auto first = std::make_shared<gui::ShownCapture>(*prepared(twoPulses(100.2)));
    first->taken = QDateTime(QDate(2026, 11, 26), QTime(16, 59, 12), QTimeZone(3600));
    model.show(first);
    const auto still = stillOf(model, screen, captionOf(model, nullptr, {}));
    EXPECT_EQ(still.caption.date, "2026-11-26 16:59:12 UTC+01:00");
    EXPECT_EQ(still.taken, first->taken);
    const auto before = gui::scopePicture(still);
    model.show(prepared(twoPulses(100.4, 10)));
    model.setTimePerDivision(20e-6);
    EXPECT_EQ(gui::scopePicture(still), before) << "the screen ran on";
    EXPECT_NE(gui::scopePicture(stillOf(model, screen, still.caption)), before);
}

TEST_F(Exports, APictureNamesTheDevicesOfTheBench) {
    SessionAbout bench;
    bench.devices.push_back({"sim:stimulator", "stimulator", "twin", "SIM-1", "1", true});
    bench.devices.push_back({"sigrok:demo", "oscilloscope", "Demo device", "", "", false});
    const auto caption = captionOf(model, &bench, {"held"});
    ASSERT_FALSE(caption.lines.isEmpty());
    EXPECT_EQ(caption.lines.front(), "twin SIM-1 (simulated) · Demo device");
    EXPECT_EQ(caption.lines.back(), "held");
}

TEST_F(Exports, NoReadingIsCutFromAPicture) {
    QStringList readings{"I:"};
    for (const auto reading : gui::allReadings()) readings << nameOf(reading).title + " 12.34\u202fmA";
    gui::PictureCaption caption{"Oscilloscope", "2026-11-23 19:00:00 UTC", {readings.join("   ")}};
    const auto path = folder.filePath("all.svg");
    ASSERT_EQ(gui::saveScopePicture(stillOf(model, screen, caption), path), std::nullopt);
    const auto drawing = QString::fromUtf8(bytes(path)).replace(QChar(QChar::Nbsp), ' ');
    for (const auto& reading : readings) EXPECT_TRUE(drawing.contains(reading)) << qPrintable(reading);
    EXPECT_FALSE(drawing.contains("…"));
    const int line = QFontMetrics(gui::textFont(gui::TextSize::Small)).lineSpacing();
    caption.lines = {"one"};
    const auto least = gui::scopePicture(stillOf(model, screen, caption)).height();
    caption.lines = {readings.join("   ")};
    const auto picture = gui::scopePicture(stillOf(model, screen, caption));
    EXPECT_GE(picture.height(), least + 2 * 2 * line) << "on further lines";
}

TEST_F(Exports, AFileThatCannotBeWrittenIsToldAndAnOldOneStays) {
    const auto wrong = gui::savePicture(screen, folder.filePath("missing/a.png"));
    ASSERT_TRUE(wrong);
    EXPECT_THAT(wrong->toStdString(), HasSubstr("was not saved"));
    EXPECT_THAT(gui::savePicture(screen, folder.filePath("a.bmp"))->toStdString(), HasSubstr(".png, .svg or .pdf"));
    const auto csv = gui::saveData(*model.shown(), 0, 1e9, folder.filePath("missing/a.csv"));
    ASSERT_TRUE(csv);
    EXPECT_THAT(csv->toStdString(), HasSubstr("was not changed"));
}

TEST_F(Exports, TheVisibleDataReadBackAsACapture) {
    const auto path = folder.filePath("part.csv");
    QFile other(path + ".part");
    ASSERT_TRUE(other.open(QIODevice::WriteOnly) && other.write("another program's work") > 0);
    other.close();
    const double zero = model.shown()->zero_s;
    ASSERT_EQ(gui::saveData(*model.shown(), zero - 0.5e-3, zero + 1.5e-3, path), std::nullopt);
    const auto read = readCapture(path.toStdString());
    ASSERT_TRUE(read) << read.error().message;
    const auto& capture = read->capture;
    EXPECT_EQ(capture.samples(), 4000U);
    EXPECT_NEAR(capture.rate_hz, 2e6, 1);
    EXPECT_NEAR(capture.start_s, zero - 0.5e-3, 1e-6);
    ASSERT_EQ(capture.channels.size(), 3U);
    EXPECT_EQ(capture.channels[0].name, "voltage");
    EXPECT_EQ(capture.channels[1].unit, "A");
    EXPECT_EQ(capture.channels[2].name, "power_w");
    for (std::size_t i = 0; i < 4000; i += 13) {
        EXPECT_EQ(capture.channels[0].samples[i], model.shown()->capture->channels[0].samples[1000 + i]);
    }
    EXPECT_EQ(QFileInfo(path + ".part").size(), 22) << "of another name, and not ours";
    EXPECT_EQ(QDir(folder.path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot).size(), 2);
    EXPECT_TRUE(gui::saveData(*model.shown(), 0, 1, path)) << "nothing on the screen is not saved";
}

}  // namespace
}  // namespace tacto::test
