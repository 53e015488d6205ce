#include "app/gui/scope/screen/LaneLegend.h"

#include <QPainter>
#include <algorithm>

#include "app/gui/scope/screen/LaneColours.h"
#include "app/gui/scope/screen/ScopePicture.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kSwatch = 20;  // pixels at 100 %
constexpr int kBesideSwatch = 8;
constexpr int kAfterAnEntry = 20;

QFont legendFont() { return textFont(TextSize::Small, QFont::DemiBold); }

}  // namespace

LaneLegend::LaneLegend(const ScopeModel& model, QWidget* parent) : QWidget(parent), model_(model) {
    setObjectName("laneLegend");
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    connect(&model_, &ScopeModel::viewChanged, this, &LaneLegend::follow);
    connect(&model_, &ScopeModel::lanesChanged, this, &LaneLegend::follow);
    onLookChange(*this, [this] { follow(); });
    follow();
}

void LaneLegend::follow() {
    std::vector<Entry> entries;
    for (const auto& lane : model_.lanes()) {
        if (!lane.shown || lane.reference() || !model_.shown()) continue;
        entries.push_back({laneScaleText(model_, lane), laneColour(model_, lane), laneInk(model_, lane)});
    }
    setVisible(!entries.empty());
    if (std::exchange(entries_, entries) == entries) return;
    QStringList words;
    for (const auto& entry : entries_) words << entry.words;
    setAccessibleName(words.join(QStringLiteral(", ")));
    updateGeometry();
    update();
}

QSize LaneLegend::sizeHint() const {
    const QFontMetrics metrics(legendFont());
    int width = 0;
    for (const auto& entry : entries_)
        width += scaledPx(kSwatch + kBesideSwatch + kAfterAnEntry) + metrics.horizontalAdvance(entry.words);
    return {width, metrics.height()};
}

void LaneLegend::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setFont(legendFont());
    const QFontMetrics metrics(legendFont());
    int at = 0;
    for (const auto& entry : entries_) {
        painter.setPen(QPen(entry.line, 2));
        painter.drawLine(at, height() / 2, at + scaledPx(kSwatch), height() / 2);
        at += scaledPx(kSwatch + kBesideSwatch);
        const int width = metrics.horizontalAdvance(entry.words);
        painter.setPen(entry.ink);
        painter.drawText(QRect(at, 0, width, height()), Qt::AlignLeft | Qt::AlignVCenter, entry.words);
        at += width + scaledPx(kAfterAnEntry);
    }
}

}  // namespace tacto::gui

#include "moc_LaneLegend.cpp"
