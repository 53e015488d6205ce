// Tests the texts in the window's plots at each size: the watermark is whole, and nothing is written twice.
#include <QSettings>
#include <QStackedWidget>
#include <gmock/gmock.h>
#include <qcustomplot.h>

#include "app/gui/theme/TabbedPage.h"
#include "tests/gui/window/WindowFixture.h"

namespace tacto::test {
namespace {

/// Returns the area that the watermark changes in the plot's picture; a cropped watermark reaches the axes.
QRect inkOf(QCustomPlot& plot, QCPItemText& mark) {
    const bool before = mark.visible();
    const auto picture = [&](bool visible) {
        mark.setVisible(visible);
        return plot.toPixmap().toImage().convertToFormat(QImage::Format_RGB32);
    };
    const auto with = picture(true), without = picture(false);
    mark.setVisible(before);
    QRect ink;
    for (int y = 0; y < with.height(); ++y) {
        const auto* a = reinterpret_cast<const QRgb*>(with.constScanLine(y));
        const auto* b = reinterpret_cast<const QRgb*>(without.constScanLine(y));
        for (int x = 0; x < with.width(); ++x)
            if (a[x] != b[x]) ink |= QRect(x, y, 1, 1);
    }
    return ink;
}

class PlotTexts : public Window {
protected:
    ~PlotTexts() override { QSettings().clear(); }
    QWidget& page() { return *window.findChild<QWidget*>("centre")->findChild<QStackedWidget*>()->currentWidget(); }
    std::vector<QCustomPlot*> plots() {
        std::vector<QCustomPlot*> visible;
        for (auto* plot : page().findChildren<QCustomPlot*>())
            if (plot->isVisible() && plot->height() > 0) visible.push_back(plot);
        return visible;
    }
    /// Calls `look` for every workspace at each size, with the name of the place.
    void everywhere(const std::function<void(const std::string&)>& look) {
        auto& live = *window.findChild<gui::TabbedPage*>("livePage");
        for (const auto& size : {QSize(1024, 640), QSize(1280, 720), QSize(1920, 1080)}) {
            window.resize(size);
            for (int workspace = 0; workspace < 7; ++workspace) {
                visit(workspace);
                for (int tab = 0; tab < (workspace == 0 ? 2 : 1); ++tab) {
                    if (workspace == 0) live.setCurrentIndex(tab);
                    letLive(60);
                    look("workspace " + std::to_string(workspace) + "." + std::to_string(tab) + " at " +
                         std::to_string(size.width()));
                }
            }
        }
        live.setCurrentIndex(0);
        visit(0);
    }
};

TEST_F(PlotTexts, AWatermarkStandsWhollyInsideItsPlotAtEachSize) {
    open();
    int seen = 0;
    everywhere([&](const std::string& where) {
        for (auto* plot : plots()) {
            for (int i = 0; i < plot->itemCount(); ++i) {
                auto* mark = qobject_cast<QCPItemText*>(plot->item(i));
                if (mark == nullptr || mark->objectName() != "watermark") continue;
                ++seen;
                const QRect room = mark->clipAxisRect()->rect().adjusted(1, 1, -1, -1);
                QRect ink = inkOf(*plot, *mark);
                // Other changes between two pictures count too, so tries again: a cropped word is cropped every time.
                for (int again = 0; again < 3 && !room.contains(ink); ++again) ink = inkOf(*plot, *mark);
                EXPECT_FALSE(ink.isEmpty()) << where << ": " << plot->accessibleName().toStdString();
                EXPECT_TRUE(room.contains(ink)) << where << ": " << plot->accessibleName().toStdString() << ", cropped";
            }
        }
    });
    EXPECT_GE(seen, 10);
}

}  // namespace
}  // namespace tacto::test
