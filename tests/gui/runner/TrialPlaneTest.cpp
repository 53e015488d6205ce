// Tests the plot of trials in the plane of their features: each condition is named at its points.
#include <QTest>
#include <gmock/gmock.h>

#include "app/gui/runner/TrialPlane.h"
#include "app/gui/theme/Theme.h"
#include "tests/gui/Person.h"

namespace tacto::test {
namespace {

class Plane : public testing::Test {
protected:
    Plane() {
        plane.resize(800, 500);
        plane.show();
        plane.begin(true);
    }
    void add(const char* condition, double volts, double interval_s) {
        for (int i = 0; i < 8; ++i)
            plane.add({{"condition", condition},
                       {"amplitude_v", volts * (1 + 0.002 * (i % 3))},
                       {"interval_s", interval_s * (1 + 0.002 * (i % 4))}});
    }
    void fourConditions() {
        add("smooth-low", 10, 2);
        add("smooth-high", 10, 0.5);
        add("rough-low", 40, 2);
        add("rough-high", 40, 0.5);
    }
    void draw() {
        for (int i = 0; i < 2; ++i) plane.replot(QCustomPlot::rpImmediateRefresh);
    }
    /// The place of the label of a condition.
    [[nodiscard]] QRectF boxOf(const QString& condition) const {
        for (int i = 0; i < plane.itemCount(); ++i) {
            auto* words = qobject_cast<QCPItemText*>(plane.item(i));
            if (words == nullptr || words->text() != condition || !words->visible()) continue;
            return QRectF(words->topLeft->pixelPosition(), words->bottomRight->pixelPosition());
        }
        return {};
    }
    gui::TrialPlane plane;
};

TEST_F(Plane, EmptyAtTheEndOfARunItSaysWhy) {
    const auto said = [&] {
        QStringList all;
        for (int i = 0; i < plane.itemCount(); ++i) {
            const auto* words = qobject_cast<QCPItemText*>(plane.item(i));
            if (words != nullptr && words->visible() && words->objectName() != "watermark") all << words->text();
        }
        return all.join(' ').toStdString();
    };
    EXPECT_THAT(said(), testing::HasSubstr("while the protocol runs"));
    plane.end();
    EXPECT_THAT(said(), testing::HasSubstr("before its first trial"));
    plane.begin(true);
    plane.add({{"condition", "rough-high"}, {"amplitude_v", nullptr}, {"interval_s", 0.5}});
    plane.end();
    EXPECT_THAT(said(), testing::HasSubstr("both amplitude and interval"));
    plane.begin(true);
    add("rough-high", 40, 0.5);
    plane.end();
    EXPECT_THAT(said(), testing::Not(testing::HasSubstr("run")));
}

TEST_F(Plane, EachClusterIsNamedAtItsPointsAndNothingIsCovered) {
    fourConditions();
    for (const auto& size : {QSize(800, 500), QSize(420, 300), QSize(1300, 800)}) {
        plane.resize(size);
        draw();
        EXPECT_TRUE(plane.namedInPlace()) << size.width();
        EXPECT_FALSE(plane.legend->visible()) << "a name that stands twice";
        EXPECT_LE(plane.axisRect()->top(), 16) << "its line is the plot's";
        for (int g = 0; g < plane.graphCount(); ++g) {
            const auto box = boxOf(plane.graph(g)->name());
            ASSERT_FALSE(box.isEmpty()) << plane.graph(g)->name().toStdString();
            EXPECT_TRUE(QRectF(plane.axisRect()->rect()).contains(box));
            for (int other = 0; other < plane.graphCount(); ++other) {
                double nearest = 1e9;
                for (const auto& point : *plane.graph(other)->data()) {
                    const QPointF at(plane.xAxis->coordToPixel(point.key), plane.yAxis->coordToPixel(point.value));
                    EXPECT_FALSE(box.contains(at));
                    nearest = std::min(nearest, QLineF(at, box.center()).length());
                }
                if (other == g) {
                    EXPECT_LT(nearest, box.width()) << "beside its own points";
                } else {
                    EXPECT_FALSE(box.intersects(boxOf(plane.graph(other)->name())));
                }
            }
        }
        shot(plane, QString("plane-%1").arg(size.width()));
    }
    gui::applyTheme(gui::Theme::Dark);
    QCoreApplication::processEvents();
    draw();
    shot(plane, "plane-dark");
}

TEST_F(Plane, WhereClustersLieInEachOtherALegendNamesThem) {
    for (const char* name : {"one", "two", "three", "four", "five", "six", "seven", "eight"}) add(name, 20, 1);
    draw();
    EXPECT_FALSE(plane.namedInPlace());
    EXPECT_TRUE(plane.legend->visible());
    EXPECT_TRUE(boxOf("one").isEmpty()) << "all at one place or none";
    EXPECT_LE(plane.legend->outerRect().bottom(), plane.axisRect()->rect().top()) << "off the data";
    plane.begin(false);
    draw();
    EXPECT_FALSE(plane.legend->visible());
    fourConditions();
    draw();
    EXPECT_TRUE(plane.namedInPlace()) << "the names before are gone";
}

}  // namespace
}  // namespace tacto::test
