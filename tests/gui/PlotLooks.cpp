#include "tests/gui/PlotLooks.h"

#include <QFontMetricsF>
#include <QPaintDevice>
#include <QPaintEngine>
#include <algorithm>
#include <cmath>
#include <map>

#include "tests/gui/Looks.h"

namespace tacto::test {

namespace {

constexpr double kTouch = 1.5;  // pixels by which two texts may overlap

/// A paint engine that records text instead of drawing it.
class WordEngine final : public QPaintEngine {
public:
    explicit WordEngine(QRectF plot) : QPaintEngine(AllFeatures), plot_(plot) {}
    bool begin(QPaintDevice*) override {
        setActive(true);
        return true;
    }
    bool end() override {
        setActive(false);
        return true;
    }
    void updateState(const QPaintEngineState&) override {}
    void drawPath(const QPainterPath&) override {}
    void drawPixmap(const QRectF&, const QPixmap&, const QRectF&) override {}
    void drawPolygon(const QPointF*, int, PolygonDrawMode) override {}
    void drawTextItem(const QPointF& at, const QTextItem& item) override {
        const auto text = item.text().trimmed();
        const auto turned = painter()->transform();
        const bool aslant = std::min(std::abs(turned.m11()), std::abs(turned.m12())) > 1e-3;
        if (text.isEmpty() || aslant || painter()->pen().color().alpha() == 0) return;
        auto ink = QFontMetricsF(item.font()).tightBoundingRect(text).translated(at);
        ink.setRight(std::min(ink.right(), at.x() + item.width()));  // another font may have narrower letters
        auto room = plot_;
        if (painter()->hasClipping()) room &= turned.mapRect(painter()->clipBoundingRect());
        words.push_back({text, turned.mapRect(ink), room, painter()->pen().color()});
    }
    [[nodiscard]] Type type() const override { return User; }

    std::vector<PlotWord> words;

private:
    QRectF plot_;
};

class WordDevice final : public QPaintDevice {
public:
    explicit WordDevice(const QWidget& of) : of_(of), engine_(of.rect()) {}
    [[nodiscard]] QPaintEngine* paintEngine() const override { return &engine_; }
    [[nodiscard]] const std::vector<PlotWord>& words() const { return engine_.words; }

protected:
    [[nodiscard]] int metric(PaintDeviceMetric metric) const override {
        switch (metric) {
            case PdmWidth:
                return of_.width();
            case PdmHeight:
                return of_.height();
            case PdmWidthMM:
                return of_.widthMM();
            case PdmHeightMM:
                return of_.heightMM();
            case PdmDpiX:
            case PdmPhysicalDpiX:
                return of_.logicalDpiX();
            case PdmDpiY:
            case PdmPhysicalDpiY:
                return of_.logicalDpiY();
            case PdmDevicePixelRatio:
                return 1;
            default:
                return QPaintDevice::metric(metric);
        }
    }

private:
    const QWidget& of_;
    mutable WordEngine engine_;
};

QString plotName(const QCustomPlot& plot) { return QString(plot.metaObject()->className()) + " " + plot.objectName(); }

template <class Follow>
void forEachPlot(const QWidget& in, Follow follow) {
    for (auto* plot : in.findChildren<QCustomPlot*>())
        if (plot->isVisible() && plot->window() == in.window() && !plot->size().isEmpty()) follow(*plot);
}

/// The points of the data in pixels, in the order in which the line connects them.
QPolygonF pointsOf(const QCPAbstractPlottable& data) {
    QPolygonF points;
    const auto* values = const_cast<QCPAbstractPlottable&>(data).interface1D();
    if (values == nullptr || data.keyAxis() == nullptr) return points;
    for (int i = 0; i < values->dataCount(); ++i) {
        const double key = data.keyAxis()->coordToPixel(values->dataMainKey(i));
        const double value = data.valueAxis()->coordToPixel(values->dataMainValue(i));
        points << (data.keyAxis()->orientation() == Qt::Horizontal ? QPointF(key, value) : QPointF(value, key));
    }
    return points;
}

bool lineMeets(const QLineF& line, const QRectF& box) {
    if (box.contains(line.p1()) || box.contains(line.p2())) return true;
    const QPointF corners[] = {box.topLeft(), box.topRight(), box.bottomRight(), box.bottomLeft()};
    return std::ranges::any_of(std::vector{0, 1, 2, 3}, [&](int side) {
        return line.intersects(QLineF(corners[side], corners[(side + 1) % 4]), nullptr) == QLineF::BoundedIntersection;
    });
}

bool covers(const QRectF& box, const QCPAbstractPlottable& data) {
    const auto points = pointsOf(data);
    const auto* graph = qobject_cast<const QCPGraph*>(&data);
    const bool joined = graph != nullptr && graph->lineStyle() != QCPGraph::lsNone;
    for (qsizetype i = 0; i < points.size(); ++i) {
        if (!std::isfinite(points[i].x()) || !std::isfinite(points[i].y())) continue;
        if (box.contains(points[i])) return true;
        if (joined && i > 0 && std::isfinite(points[i - 1].y()) && lineMeets({points[i - 1], points[i]}, box))
            return true;
    }
    return false;
}

}  // namespace

std::vector<PlotWord> wordsOf(QCustomPlot& plot) {
    WordDevice device(plot);
    QCPPainter painter(&device);
    plot.toPainter(&painter, plot.width(), plot.height());
    painter.end();
    auto words = device.words();
    std::erase_if(words, [&plot](const PlotWord& word) {
        for (int i = 0; i < plot.itemCount(); ++i) {
            const auto* item = qobject_cast<const QCPItemText*>(plot.item(i));
            if (item != nullptr && item->objectName() == "watermark" && item->text() == word.text) return true;
        }
        return false;
    });
    return words;
}

QStringList plotWordFaults(const QWidget& in) {
    QStringList found;
    forEachPlot(in, [&](QCustomPlot& plot) {
        auto words = wordsOf(plot);
        std::erase_if(words, [](const PlotWord& word) { return !word.ink.intersects(word.room); });
        for (const auto& word : words)
            if (!word.room.adjusted(-kTouch, -kTouch, kTouch, kTouch).contains(word.ink))
                found << QString("\"%1\" is cut in %2").arg(word.text, plotName(plot));
        for (auto one = words.begin(); one != words.end(); ++one) {
            for (auto other = one + 1; other != words.end(); ++other) {
                const auto both = one->ink.intersected(other->ink);
                if (both.width() > kTouch && both.height() > kTouch)
                    found << QString("\"%1\" and \"%2\" lie over each other in %3: %4x%5")
                                 .arg(one->text, other->text, plotName(plot))
                                 .arg(both.width(), 0, 'f', 0)
                                 .arg(both.height(), 0, 'f', 0);
            }
        }
    });
    return found;
}

namespace {

/// Returns the most frequent colour of the place: the letters cover less of it than the background.
QColor groundOf(const QImage& picture, const QRectF& place) {
    std::map<QRgb, int> count;
    const auto within = place.toAlignedRect().adjusted(-2, -2, 2, 2) & picture.rect();
    for (int y = within.top(); y <= within.bottom(); ++y)
        for (int x = within.left(); x <= within.right(); ++x) ++count[picture.pixel(x, y)];
    const auto most = std::ranges::max_element(count, {}, [](const auto& each) { return each.second; });
    return most == count.end() ? QColor() : QColor(most->first);
}

}  // namespace

QStringList palePlotWords(const QWidget& in) {
    QStringList found;
    forEachPlot(in, [&](QCustomPlot& plot) {
        const auto picture = plot.toPixmap(0, 0, 1).toImage().convertToFormat(QImage::Format_RGB32);
        for (const auto& word : wordsOf(plot)) {
            if (!word.ink.intersects(word.room)) continue;
            const auto ground = groundOf(picture, word.ink);
            if (ground.isValid() && contrast(word.colour, ground) < 4.5)
                found << QString("\"%1\" in %2: %3 on %4")
                             .arg(word.text, plotName(plot), word.colour.name(), ground.name());
        }
    });
    return found;
}

QStringList legendsOverData(const QWidget& in) {
    QStringList found;
    forEachPlot(in, [&](QCustomPlot& plot) {
        for (auto* axes : plot.axisRects()) {
            for (auto* element : axes->insetLayout()->elements(false)) {
                const auto* legend = qobject_cast<const QCPLegend*>(element);
                if (legend == nullptr || !legend->realVisibility() || legend->itemCount() == 0) continue;
                for (const auto* data : axes->plottables())
                    if (data->realVisibility() && covers(QRectF(legend->outerRect()), *data))
                        found << QString("the legend lies over \"%1\" in %2").arg(data->name(), plotName(plot));
            }
        }
    });
    return found;
}

QStringList smallAxisTitles(const QWidget& in) {
    QStringList found;
    forEachPlot(in, [&](const QCustomPlot& plot) {
        for (const auto* axes : plot.axisRects()) {
            for (const auto* axis : axes->axes()) {
                const auto title = axis->label();
                if (axis->visible() && !title.isEmpty() && title.front().isLower())
                    found << QString("\"%1\" in %2").arg(title, plotName(plot));
            }
        }
    });
    return found;
}

}  // namespace tacto::test
