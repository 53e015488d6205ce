#include "app/gui/theme/Theme.h"

#include <QEvent>
#include <QLabel>
#include <QPainterPath>
#include <QPushButton>
#include <QVBoxLayout>
#include <cmath>
#include <map>
#include <optional>
#include <typeinfo>
#include <utility>

#include "app/gui/theme/Colours.h"
#include "app/gui/theme/Style.h"
#include "app/gui/theme/TableText.h"

namespace tacto::gui {

namespace {

std::optional<Theme> applied;

constexpr double kSmallestText_pt = 10.5;

void applySheet() { qApp->setStyleSheet(styleSheetOf(currentTheme(), QApplication::font())); }

/// Sets a property that the style sheet uses.
void setStyled(QWidget& widget, const char* name, const QString& value) {
    if (widget.property(name).toString() == value) return;
    widget.setProperty(name, value);
    widget.style()->unpolish(&widget);
    widget.style()->polish(&widget);
}

}  // namespace

void applyTheme(Theme wanted) {
    WheelGuard::install();
    TableCopies::install();
    if (applied == wanted) return;
    applied = wanted;
    qApp->setStyleSheet({});  // otherwise each of the three calls would restyle every widget
    QApplication::setStyle(new MnemonicStyle);
    QApplication::setPalette(paletteOf(colours()));
    // In Qt 6.8 a label can keep the colour from the other theme's style sheet.
    for (auto* widget : QApplication::allWidgets())
        if (widget->property("tone").isValid()) widget->setPalette(QPalette());
    applySheet();
}

void applyTextSize(int percent) {
    static const double desktops_pt = QApplication::font().pointSizeF();
    auto font = QApplication::font();
    // Debian's Noto Sans lacks minus, ≤ and arrows; Noto Sans Math has them in the same widths. Reports use the same
    // fonts (app/report/Fonts.cpp).
    font.setFamilies({"Noto Sans", "Noto Sans Math", "DejaVu Sans"});
    font.setPointSizeF(std::max(desktops_pt, kSmallestText_pt) * (percent < 100 || percent > 200 ? 100 : percent) /
                       100);
    if (font == QApplication::font()) return;
    // Widgets keep the fonts set while a style sheet was active, so the sheet is removed for a moment.
    qApp->setStyleSheet({});
    QApplication::setFont(font);
    // Widgets that were never shown would otherwise keep the old font.
    for (auto* widget : QApplication::allWidgets())
        if (!widget->testAttribute(Qt::WA_SetFont)) widget->setFont(QFont());
    applySheet();
}

Theme currentTheme() { return applied.value_or(Theme::Light); }

const Colours& colours() { return coloursOf(currentTheme()); }

QFont textFont(TextSize size, QFont::Weight weight) {
    auto font = QApplication::font();
    const double scale = size == TextSize::Small     ? 9 / 10.5
                         : size == TextSize::Large   ? 15 / 10.5
                         : size == TextSize::Display ? kDisplayText
                                                     : 1;
    font.setPointSizeF(font.pointSizeF() * scale);
    font.setWeight(weight);
    return font;
}

void setTextSize(QWidget& widget, TextSize size, bool strong) {
    const char* name = size == TextSize::Small ? "small" : size == TextSize::Large ? "large" : "";
    setStyled(widget, "textSize", size == TextSize::Display ? "display" : name);
    setStyled(widget, "textWeight", strong ? "strong" : "");
}

void setTone(QLabel& label, Tone tone) {
    setStyled(label, "tone", tone == Tone::Quiet ? "quiet" : tone == Tone::Warning ? "warning" : "");
}

int scaledPx(int px) { return int(std::lround(px * QApplication::font().pointSizeF() / kSmallestText_pt)); }

void makePrimary(QPushButton& button, bool primary) { setStyled(button, "role", primary ? "primary" : ""); }

void makeQuiet(QPushButton& button) { setStyled(button, "role", "quiet"); }

void letYield(QWidget& page, bool yields) {
    // For the icons on them, which get their colour when painted (Icons.cpp); also after another window that yielded.
    qApp->setProperty("primariesYield", yields);
    if (page.property("yields").toBool() == yields) return;
    page.setProperty("yields", yields);
    for (auto* button : page.findChildren<QPushButton*>()) {
        if (button->property("role") != "primary") continue;
        button->style()->unpolish(button);
        button->style()->polish(button);
    }
}

void makeActionBar(QWidget& bar) {
    bar.setAttribute(Qt::WA_StyledBackground);
    setStyled(bar, "role", "actions");
}

bool isActionBar(const QWidget& widget) { return widget.property("role") == "actions"; }

ConditionStyle conditionInTheme(const QString& name, int index) {
    static const std::map<QString, QColor> onDark{
        {"smooth-low", "#8CCBF0"}, {"smooth-high", "#56B4E9"}, {"rough-low", "#F0AE1D"}, {"rough-high", "#F07F2E"}};
    auto style = conditionStyle(name, index);
    if (currentTheme() != Theme::Dark) return style;
    if (const auto found = onDark.find(name); found != onDark.end()) style.color = found->second;
    // The darkest of the other colours would be invisible on a dark background.
    if (style.color.lightnessF() < 0.4) style.color = style.color.lighter(165);
    return style;
}

StateStyle stateStyle(InterlockState state) {
    const auto& c = colours();
    switch (state) {
        case InterlockState::Disconnected:
            return {QObject::tr("DISCONNECTED"), "◌", "state-disconnected", c.base, c.quiet};
        case InterlockState::Disarmed:
            return {QObject::tr("DISARMED"), "◯", "state-disarmed", c.base, c.text};
        case InterlockState::Checking:
            return {QObject::tr("CHECKING"), "◔", "state-checking", c.base, c.text};
        case InterlockState::Armed:
            return {QObject::tr("ARMED"), "▲", "state-armed", c.amber, c.amberInk};
        case InterlockState::Delivering:
            return {QObject::tr("DELIVERING"), "●", "state-delivering", c.delivering, Qt::white};
        case InterlockState::Paused:
            return {QObject::tr("PAUSED"), "‖", "state-paused", c.base, c.text};
        case InterlockState::Faulted:
            break;
    }
    return {QObject::tr("FAULTED"), "■", "state-faulted", c.stop, Qt::white};
}

QString ageText(double seconds) {
    if (!std::isfinite(seconds)) return "–";
    if (seconds < 1) return QObject::tr("just now");
    if (seconds < 120) return QObject::tr("%1 s ago").arg(int(seconds));
    if (seconds < 7200) return QObject::tr("%1 min ago").arg(int(seconds / 60));
    return QObject::tr("%1 h ago").arg(int(seconds / 3600));
}

QFont digits(QFont font, double scale) {
    if (font.pointSizeF() > 0) font.setPointSizeF(font.pointSizeF() * scale);
    font.setStyleHint(QFont::SansSerif);
    return font;
}

namespace {

/// A ticker that writes negative numbers with a minus sign instead of a hyphen.
class MinusTicker final : public QCPAxisTicker {
protected:
    QString getTickLabel(double tick, const QLocale& locale, QChar format, int precision) override {
        return QCPAxisTicker::getTickLabel(tick, locale, format, precision).replace('-', QChar(0x2212));
    }
};

}  // namespace

void styleAxis(QCPAxis& axis) {
    const auto& c = colours();
    const auto own = axis.ticker();
    if (const auto& kind = *own; typeid(kind) == typeid(QCPAxisTicker)) {
        const auto ticker = QSharedPointer<MinusTicker>::create();
        ticker->setTickCount(own->tickCount());
        ticker->setTickOrigin(own->tickOrigin());
        ticker->setTickStepStrategy(own->tickStepStrategy());
        axis.setTicker(ticker);
    }
    const auto small = textFont(TextSize::Small);
    axis.setBasePen(QPen(c.frame, 1));
    axis.setTickPen(QPen(c.frame, 1));
    axis.setSubTickPen(Qt::NoPen);
    axis.setTickLabelColor(c.quiet);
    axis.setLabelColor(c.quiet);
    axis.setTickLabelFont(small);
    axis.setLabelFont(small);
    axis.grid()->setPen(QPen(c.grid, 1));
    axis.grid()->setZeroLinePen(QPen(c.zero, 1));
    axis.grid()->setSubGridVisible(false);
}

namespace {

/// Shows the sides without a scale as plain edges, so that the frame is closed.
void closeFrame(QCPAxisRect& rect) {
    if (!rect.visible() || !rect.axis(QCPAxis::atLeft)->visible() || !rect.axis(QCPAxis::atBottom)->visible()) return;
    for (const auto side : {QCPAxis::atTop, QCPAxis::atRight}) {
        auto* edge = rect.axis(side);
        if (edge == nullptr || edge->visible()) continue;
        edge->setVisible(true);
        edge->setTicks(false);
        edge->setTickLabels(false);
        edge->grid()->setVisible(false);
    }
}

}  // namespace

void stylePlot(QCustomPlot& plot) {
    plot.setBackground(QBrush(colours().base));
    for (auto* rect : plot.axisRects()) {
        closeFrame(*rect);
        for (auto* axis : rect->axes()) styleAxis(*axis);
    }
    for (int i = 0; i < plot.itemCount(); ++i) {
        auto* item = plot.item(i);
        if (item->objectName() != "watermark") continue;
        static_cast<QCPItemText*>(item)->setColor(colours().watermark);
    }
}

namespace {

/// A word as large as its axes allow, because a cut word says nothing.
class Watermark final : public QCPItemText {
public:
    Watermark(QCustomPlot* plot, bool outlined) : QCPItemText(plot), outlined_(outlined) {}

protected:
    void draw(QCPPainter* painter) override {
        constexpr double kRoomUsed = 0.9;
        const auto whole = mFont;
        const QSizeF room = clipAxisRect()->size();
        const QSizeF needed =
            QTransform().rotate(mRotation).mapRect(QRectF(QFontMetrics(mFont).boundingRect(mText))).size();
        const double fits = kRoomUsed * std::min(room.width() / needed.width(), room.height() / needed.height());
        if (fits > 0 && fits < 1) mFont.setPointSizeF(std::max(1.0, mFont.pointSizeF() * fits));
        painter->save();  // drawing text does not restore the painter
        QCPItemText::draw(painter);
        painter->restore();
        if (outlined_) outline(*painter);
        mFont = whole;
    }

private:
    /// Draws two outlines, so that one is visible on any background.
    void outline(QCPPainter& painter) const {
        QPainterPath word;
        word.addText(0, 0, mFont, mText);
        const auto centre = word.boundingRect().center();
        painter.save();
        painter.setRenderHint(QPainter::Antialiasing);
        painter.translate(position->pixelPosition());
        painter.rotate(mRotation);
        painter.translate(-centre);
        painter.setBrush(Qt::NoBrush);
        painter.setPen(QPen(colours().base, kOutline_px));
        painter.drawPath(word);
        auto faint = colours().text;
        faint.setAlpha(kOutlineAlpha);
        painter.setPen(QPen(faint, 1));
        painter.drawPath(word);
        painter.restore();
    }
    static constexpr double kOutline_px = 1.5;
    static constexpr int kOutlineAlpha = 60;
    const bool outlined_;
};

}  // namespace

QCPItemText* addWatermark(QCPAxisRect& axes, WatermarkPlace place) {
    auto* plot = axes.parentPlot();
    const bool inFront = place == WatermarkPlace::InFront;
    const QString layer = inFront ? "watermark in front" : "watermark";
    if (plot->layer(layer) == nullptr)
        plot->addLayer(layer, plot->layer(inFront ? "main" : "grid"), QCustomPlot::limAbove);
    auto* item = new Watermark(plot, inFront);
    item->setObjectName("watermark");
    item->setLayer(layer);
    item->setClipAxisRect(&axes);
    item->position->setAxisRect(&axes);
    item->position->setType(QCPItemPosition::ptAxisRectRatio);
    item->position->setCoords(0.5, 0.5);
    item->setText(QObject::tr("SIMULATED"));
    item->setRotation(-20);
    item->setSelectable(false);
    item->setFont(textFont(TextSize::Display, QFont::Bold));
    item->setColor(colours().watermark);
    return item;
}

void showWatermark(QCPItemText& watermark, bool simulated) {
    if (watermark.visible() == simulated) return;
    watermark.setVisible(simulated);
    watermark.parentPlot()->replot(QCustomPlot::rpQueuedReplot);
}

QWidget* heading(const QString& text, QWidget* parent) {
    auto* label = new QLabel(text, parent);
    setTextSize(*label, TextSize::Large);
    return label;
}

QFrame* lineAcross(QWidget* parent) {
    auto* line = new QFrame(parent);
    line->setFrameShape(QFrame::HLine);
    line->setForegroundRole(QPalette::Mid);
    return line;
}

QWidget* explanation(const QString& text, QWidget* parent) {
    auto* label = new QLabel(text, parent);
    label->setWordWrap(true);
    setTone(*label, Tone::Quiet);
    return label;
}

EmptyState::EmptyState(const QString& what, const QString& next, QWidget* parent) : QWidget(parent) {
    auto* layout = new QVBoxLayout(this);
    layout->addStretch();
    auto* label = new QLabel(what, this);
    label->setAlignment(Qt::AlignCenter);
    label->setWordWrap(true);
    layout->addWidget(label);
    if (!next.isEmpty()) {
        auto* button = new QPushButton(next, this);
        connect(button, &QPushButton::clicked, this, &EmptyState::nextStep);
        makePrimary(*button);
        layout->addSpacing(12);
        layout->addWidget(button, 0, Qt::AlignCenter);
    }
    layout->addStretch();
}

namespace {

/// Calls `follow` on a change of font, and with `all` also of palette; at once or in the next turn of the event loop.
class LookChange final : public QObject {
public:
    LookChange(QWidget& widget, bool all, Qt::ConnectionType when, std::function<void()> follow)
        : QObject(&widget), all_(all), when_(when), follow_(std::move(follow)) {
        widget.installEventFilter(this);
    }
    bool eventFilter(QObject*, QEvent* event) override {
        const auto type = event->type();
        const bool queued = when_ == Qt::QueuedConnection;
        const bool look = type == QEvent::PaletteChange || (queued && type == QEvent::StyleChange);
        if (type != QEvent::FontChange && !(all_ && look)) return false;
        if (!queued) return follow_(), false;
        if (std::exchange(waits_, true)) return false;
        const auto turn = [this] {
            waits_ = false;
            follow_();
        };
        QMetaObject::invokeMethod(this, turn, when_);
        return false;
    }

private:
    const bool all_;
    const Qt::ConnectionType when_;
    const std::function<void()> follow_;
    bool waits_ = false;
};

class EventFollower final : public QObject {
public:
    EventFollower(QWidget& widget, QEvent::Type event, std::function<void()> follow)
        : QObject(&widget), event_(event), follow_(std::move(follow)) {
        widget.installEventFilter(this);
    }
    bool eventFilter(QObject*, QEvent* event) override {
        if (event->type() == event_) follow_();
        return false;
    }

private:
    const QEvent::Type event_;
    const std::function<void()> follow_;
};

}  // namespace

void onEvent(QWidget& widget, QEvent::Type event, std::function<void()> follow) {
    new EventFollower(widget, event, std::move(follow));
}
void onLookChange(QWidget& widget, std::function<void()> follow) {
    new LookChange(widget, true, Qt::DirectConnection, std::move(follow));
}
void onFontChange(QWidget& widget, std::function<void()> follow) {
    new LookChange(widget, false, Qt::DirectConnection, std::move(follow));
}
void afterLookChange(QWidget& widget, std::function<void()> follow) {
    new LookChange(widget, true, Qt::QueuedConnection, std::move(follow));
}

void boundWidth(QWidget& widget, int atMost_px) {
    const auto bound = [&widget, atMost_px] { widget.setMaximumWidth(scaledPx(atMost_px)); };
    bound();
    onFontChange(widget, bound);
}

void fixWidth(QWidget& widget, int px) {
    const auto fix = [&widget, px] { widget.setFixedWidth(scaledPx(px)); };
    fix();
    onFontChange(widget, fix);
}

}  // namespace tacto::gui

#include "moc_Theme.cpp"
