#include "app/gui/theme/Icons.h"

#include <QApplication>
#include <QFile>
#include <QIconEngine>
#include <QPainter>
#include <QPixmapCache>
#include <QSvgRenderer>
#include <algorithm>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

// The shape of a verdict must be recognised from afar, so its lines are as heavy as the bold word next to it.
constexpr const char kToolLine[] = R"(stroke-width="1.5")", kVerdictLine[] = R"(stroke-width="2.4")";

QString fileOf(const QString& name) { return ":/icons/" + name + ".svg"; }

void paintIcon(QPainter& painter, const QString& name, const QColor& colour, const QRectF& place) {
    QFile file(fileOf(name));
    if (!file.open(QIODevice::ReadOnly)) return;
    auto shape = file.readAll().replace("currentColor", colour.name().toLatin1());
    if (name.startsWith("verdict-")) shape.replace(kToolLine, kVerdictLine);
    QSvgRenderer drawing(shape);
    // In a wider place the free room is at the right.
    const double side = std::min(place.width(), place.height());
    drawing.render(&painter, {place.left(), place.center().y() - side / 2, side, side});
}

class ThemeIcon final : public QIconEngine {
public:
    ThemeIcon(QString name, Ink ink) : name_(std::move(name)), ink_(ink) {}

    void paint(QPainter* painter, const QRect& place, QIcon::Mode mode, QIcon::State /*state*/) override {
        paintIcon(*painter, name_, colour(mode), place);
    }
    QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
        return scaledPixmap(size, mode, state, 1);
    }
    QPixmap scaledPixmap(const QSize& size, QIcon::Mode mode, QIcon::State /*state*/, double /*scale*/) override {
        const auto ink = colour(mode);
        const auto key = QString("%1 %2 %3x%4").arg(name_, ink.name()).arg(size.width()).arg(size.height());
        QPixmap pixmap;
        if (QPixmapCache::find(key, &pixmap)) return pixmap;
        pixmap = QPixmap(size);
        pixmap.fill(Qt::transparent);
        QPainter painter(&pixmap);
        paintIcon(painter, name_, ink, QRectF(QPointF(), QSizeF(size)));
        painter.end();
        QPixmapCache::insert(key, pixmap);
        return pixmap;
    }
    QIconEngine* clone() const override { return new ThemeIcon(*this); }
    QString iconName() override { return name_; }
    bool isNull() override { return false; }

private:
    [[nodiscard]] QColor colour(QIcon::Mode mode) const {
        const auto& c = colours();
        if (mode == QIcon::Disabled) return c.edge;
        const bool onPrimary = ink_ == Ink::Primary && !qApp->property("primariesYield").toBool();
        return onPrimary ? c.primaryText : c.text;
    }

    QString name_;
    Ink ink_;
};

}  // namespace

QIcon icon(const QString& name, Ink ink) {
    if (!QFile::exists(fileOf(name))) return {};
    return QIcon(new ThemeIcon(name, ink));
}

QPixmap iconPixmap(const QString& name, const QColor& colour, int size, double scale) {
    QPixmap pixmap(QSize(size, size) * scale);
    pixmap.setDevicePixelRatio(scale);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    paintIcon(painter, name, colour, QRectF(0, 0, size, size));
    return pixmap;
}

}  // namespace tacto::gui
