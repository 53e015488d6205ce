// Tests pictures of plots: taken at the moment of asking, with a caption of what they show; and their tools.
#include <QClipboard>
#include <QFile>
#include <QHBoxLayout>
#include <QLabel>
#include <QTemporaryDir>
#include <gmock/gmock.h>
#include <qcustomplot.h>

#include "app/gui/theme/Labels.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/ToolRow.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class Picture : public testing::Test {
protected:
    Picture() {
        gui::applyTheme(gui::Theme::Light);
        plot.resize(400, 300);
        plot.xAxis->setLabel("Interval (s)");
        plot.yAxis->setLabel("Amplitude (V)");
        plot.addGraph();
        draw(1);
    }
    void draw(double height) {
        plot.graph(0)->setData({0, 1, 2}, {0, height, 0});
        plot.xAxis->setRange(0, 2.2);
        plot.yAxis->setRange(0, 2);
        plot.replot();
    }
    std::string saved(const gui::Still& still, const char* name) {
        const auto path = folder.filePath(name);
        EXPECT_EQ(gui::savePicture(still, path), std::nullopt);
        QFile file(path);
        EXPECT_TRUE(file.open(QIODevice::ReadOnly));
        return file.readAll().toStdString();
    }
    QTemporaryDir folder;
    QCustomPlot plot;
};

TEST_F(Picture, IsOfItsMomentAndSaysWhatItShows) {
    const auto bare = gui::pictureOf(plot, 2);
    EXPECT_EQ(bare.size(), plot.size() * 2);
    int asked = 0;
    gui::captionPictures(plot, [&] {
        ++asked;
        return gui::PictureCaption{gui::pictureTitle("Trials", true),
                                   "2026-11-27 20:30:00 UTC",
                                   {gui::axesText(plot), QString(), "twin SIM-1 · " + QString(80, 'w') + " · last"}};
    });
    const gui::Still still(plot);
    EXPECT_EQ(asked, 1);
    const auto then = gui::pictureOf(still, 2);
    draw(2);
    EXPECT_EQ(gui::pictureOf(still, 2), then) << "the plot went on";
    EXPECT_NE(gui::pictureOf(plot, 2), then);
    const int margin = 2 * gui::PictureCaption::kMargin;
    EXPECT_EQ(then.width(), bare.width() + 2 * margin);
    EXPECT_GT(then.height(), bare.height() + margin + 100) << "the caption takes nothing from the plot";
    EXPECT_EQ(then.copy(margin, then.height() - margin - bare.height(), bare.width(), bare.height()), bare)
        << "pixel by pixel";
    const auto drawing = saved(still, "a.svg");
    for (const auto* said : {"Trials · simulated", "2026-11-27 20:30:00 UTC",
                             "Interval (s) 0 to 2.2 · Amplitude (V) 0 to 2", "twin SIM-1", "last"})
        EXPECT_THAT(drawing, HasSubstr(said));
    EXPECT_THAT(drawing, testing::Not(HasSubstr("<image"))) << "a drawing";
    EXPECT_THAT(saved(still, "a.pdf"), testing::StartsWith("%PDF"));
    static_cast<void>(saved(still, "a.png"));
    EXPECT_EQ(QImage(folder.filePath("a.png")).size(), then.size());
}

TEST_F(Picture, ASentenceThatIsWiderGoesOnInAnotherLine) {
    const QString sentence(
        "Known limit of R: on the public sliding data tried so far its features are repeatable and specific to a "
        "material, but do not by themselves rank felt roughness.");
    gui::captionPictures(plot, [&] { return gui::PictureCaption{"Trials", {}, {sentence}}; });
    const auto drawing = saved(plot, "c.svg");
    for (const auto& word : sentence.split(' ')) EXPECT_THAT(drawing, HasSubstr(word.toStdString()));
    EXPECT_THAT(drawing, testing::Not(HasSubstr("…")));
}

TEST_F(Picture, OfAWidgetIsADrawingToo) {
    QLabel words("Peak voltage");
    words.resize(200, 40);
    const auto drawing = saved({words, {"Limits", "today", {}}}, "b.svg");
    EXPECT_THAT(drawing, HasSubstr("Peak voltage"));
    EXPECT_THAT(drawing, HasSubstr("Limits"));
}

TEST_F(Picture, ToolsTakeWhatIsShownWhenTheyAreClicked) {
    QWidget window;
    auto* row = new QHBoxLayout(&window);
    gui::PictureTools tools(&window);
    tools.addTo(*row);
    tools.takeFrom([this] { return gui::Still(plot); }, "trials");
    window.show();
    QGuiApplication::clipboard()->clear();
    click(tools.copy());
    EXPECT_EQ(QGuiApplication::clipboard()->image(), gui::pictureOf(plot, 2));
    int alone = 0;
    QObject::connect(&tools, &gui::PictureTools::plotOnlyWanted, [&] { ++alone; });
    click(tools.plotOnly());
    EXPECT_EQ(alone, 1);
}

TEST(ToolsInARow, HaveTheRoomBeforeWhatStandsBetweenThem) {
    gui::applyTheme(gui::Theme::Light);
    QWidget window;
    auto* row = new gui::ToolRow(&window);
    auto* first = gui::makeTool("Fit", {}, "fit", &window);
    row->addWidget(first);
    auto* words = new gui::ElidedLabel("Samples are fresh, no gaps, none lost", &window);
    row->addBetween(words);
    gui::PictureTools pictures(&window);
    pictures.addTo(*row);
    window.resize(600, 40);
    window.show();
    ASSERT_IN_TIME(comesTrue([&] { return pictures.plotOnly().isVisible() && words->width() > 200; }));
    EXPECT_GE(pictures.plotOnly().geometry().right(), 598) << "at the right end";
    EXPECT_GE(pictures.save().x(), words->geometry().right());
    window.resize(row->sizeHint().width() + 20, 40);
    ASSERT_IN_TIME(comesTrue([&] { return words->width() <= 20; })) << words->width();
    EXPECT_TRUE(pictures.plotOnly().isVisible());
    window.resize(first->sizeHint().width() * 3, 40);
    EXPECT_IN_TIME(comesTrue([&] { return !pictures.plotOnly().isVisible() && first->isVisible(); }));
    EXPECT_NE(find<QToolButton>(window, "More tools"), nullptr) << "where the others are";
}

}  // namespace
}  // namespace tacto::test
