#include "app/gui/look/Look.h"

#include <QLabel>
#include <QPushButton>
#include <QStyleFactory>
#include <QVBoxLayout>

namespace tacto::gui {

namespace {

Theme theme = Theme::Light;

const Colours kLight{.base = QColor("#ffffff"),
                     .text = QColor("#1d2125"),
                     .quiet = QColor("#5a6169"),
                     .grid = QColor("#e6e9ec"),
                     .voltage = QColor("#0072b2"),
                     .current = QColor("#009e73"),
                     .math = QColor("#b0558a"),
                     .reference = QColor("#9aa1a8"),
                     .accent = QColor("#0b62a3"),
                     .amber = QColor("#e69f00"),
                     .amberText = QColor("#7a4f00"),
                     .fault = QColor("#c1121f"),
                     .good = QColor("#0b62a3"),
                     .watermark = QColor(0, 0, 0, 22)};

const Colours kDark{.base = QColor("#16191c"),
                    .text = QColor("#e8eaec"),
                    .quiet = QColor("#a4abb2"),
                    .grid = QColor("#2a2f34"),
                    .voltage = QColor("#56b4e9"),
                    .current = QColor("#2fc99b"),
                    .math = QColor("#e09ac4"),
                    .reference = QColor("#747b82"),
                    .accent = QColor("#5db0ea"),
                    .amber = QColor("#f0ae1d"),
                    .amberText = QColor("#f5c558"),
                    .fault = QColor("#ff7a7f"),
                    .good = QColor("#5db0ea"),
                    .watermark = QColor(255, 255, 255, 26)};

QPalette paletteOf(const Colours& c, bool dark) {
    const QColor window = dark ? QColor("#202428") : QColor("#f4f5f7");
    const QColor button = dark ? QColor("#2c3136") : QColor("#ffffff");
    QPalette p;
    p.setColor(QPalette::Window, window);
    p.setColor(QPalette::WindowText, c.text);
    p.setColor(QPalette::Base, c.base);
    p.setColor(QPalette::AlternateBase, dark ? QColor("#1c2024") : QColor("#f7f8fa"));
    p.setColor(QPalette::Text, c.text);
    p.setColor(QPalette::PlaceholderText, c.quiet);
    p.setColor(QPalette::Button, button);
    p.setColor(QPalette::ButtonText, c.text);
    p.setColor(QPalette::BrightText, c.fault);
    p.setColor(QPalette::Highlight, c.accent);
    p.setColor(QPalette::HighlightedText, dark ? QColor("#0d1013") : QColor("#ffffff"));
    p.setColor(QPalette::ToolTipBase, dark ? QColor("#2c3136") : QColor("#fffef5"));
    p.setColor(QPalette::ToolTipText, c.text);
    p.setColor(QPalette::Link, c.accent);
    p.setColor(QPalette::LinkVisited, c.accent);
    p.setColor(QPalette::Mid, dark ? QColor("#3a4046") : QColor("#c9ced3"));
    p.setColor(QPalette::Midlight, dark ? QColor("#33383e") : QColor("#e2e5e9"));
    p.setColor(QPalette::Dark, dark ? QColor("#101316") : QColor("#9aa1a8"));
    p.setColor(QPalette::Light, dark ? QColor("#3a4046") : QColor("#ffffff"));
    p.setColor(QPalette::Shadow, dark ? QColor("#000000") : QColor("#80868c"));
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
        p.setColor(QPalette::Disabled, role, dark ? QColor("#7b828a") : QColor("#868d94"));
    }
    p.setColor(QPalette::Disabled, QPalette::Highlight, dark ? QColor("#3a4046") : QColor("#c9ced3"));
    return p;
}

}  // namespace

void applyTheme(Theme wanted) {
    theme = wanted;
    QApplication::setStyle(QStyleFactory::create("Fusion"));
    const auto palette = paletteOf(colours(), wanted == Theme::Dark);
    QApplication::setPalette(palette);
    // Fusion draws outlines darker than the window, which a dark one swallows.
    const auto boxes =
        wanted == Theme::Dark
            ? QString(
                  "QCheckBox::indicator, QTreeView::indicator, QRadioButton::indicator, "
                  "QGroupBox::indicator { width: 1em; height: 1em; border: 1px solid %1; "
                  "background: %2; }"
                  "QTreeView::indicator { width: 0.7em; height: 0.7em; }"
                  "QRadioButton::indicator { border-radius: 0.5em; }"
                  "QCheckBox::indicator:checked, QTreeView::indicator:checked, "
                  "QRadioButton::indicator:checked, QGroupBox::indicator:checked "
                  "{ background: %3; border-color: %3; }"
                  "QCheckBox::indicator:disabled, QRadioButton::indicator:disabled "
                  "{ border-color: %4; }")
                  .arg(colours().quiet.name(), colours().base.name(), colours().accent.name(), colours().grid.name())
            : QString();
    // Quiet: no icons in dialog buttons, flat bars, the workspaces as a list.
    qApp->setStyleSheet(QString("QDialogButtonBox { dialogbuttonbox-buttons-have-icons: 0; }"
                                "QToolBar { background: %1; border: none; spacing: 2px; }"
                                "QToolButton#workspaceButton { text-align: left; padding: 7px 12px; border: none; }"
                                "QToolButton#workspaceButton:hover { background: %2; }"
                                "QToolButton#workspaceButton:checked { background: %3; color: %4; }"
                                "QToolButton#workspaceButton:focus { border: 1px solid %3; }")
                            .arg(palette.color(QPalette::Window).name(), palette.color(QPalette::Midlight).name(),
                                 palette.color(QPalette::Highlight).name(),
                                 palette.color(QPalette::HighlightedText).name()) +
                        boxes);
}

void applyTextSize(int percent) {
    static const double desktops_pt = QApplication::font().pointSizeF();
    auto font = QApplication::font();
    font.setPointSizeF(desktops_pt * (percent < 100 || percent > 200 ? 100 : percent) / 100);
    // A style sheet keeps the fonts it met: without it for a moment, widgets take the new one.
    const auto sheet = qApp->styleSheet();
    qApp->setStyleSheet({});
    QApplication::setFont(font);
    qApp->setStyleSheet(sheet);
}

Theme currentTheme() { return theme; }

const Colours& colours() { return theme == Theme::Dark ? kDark : kLight; }

ConditionStyle conditionLook(const QString& name, int index) {
    auto style = conditionStyle(name, index);
    // The darkest of the set would sink into a dark ground.
    if (theme == Theme::Dark && style.color.lightnessF() < 0.4) style.color = style.color.lighter(165);
    return style;
}

StateLook stateLook(InterlockState state) {
    const auto& c = colours();
    const bool dark = theme == Theme::Dark;
    switch (state) {
        case InterlockState::Disconnected:
            return {QObject::tr("DISCONNECTED"), "◌", c.base, c.quiet};
        case InterlockState::Disarmed:
            return {QObject::tr("DISARMED"), "◯", c.base, c.text};
        case InterlockState::Checking:
            return {QObject::tr("CHECKING"), "◔", c.base, c.text};
        case InterlockState::Armed:
            return {QObject::tr("ARMED"), "▲", c.amber, dark ? QColor("#14171b") : QColor("#1a1f25")};
        case InterlockState::Delivering:
            return {QObject::tr("DELIVERING"), "●", QColor("#0072b2"), Qt::white};
        case InterlockState::Paused:
            return {QObject::tr("PAUSED"), "‖", c.base, c.text};
        case InterlockState::Faulted:
            break;
    }
    return {QObject::tr("FAULTED"), "■", dark ? QColor("#d0202b") : QColor("#c1121f"), Qt::white};
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

void styleAxis(QCPAxis& axis) {
    const auto& c = colours();
    auto small = QApplication::font();
    if (small.pointSizeF() > 0) small.setPointSizeF(small.pointSizeF() * 0.9);
    axis.setBasePen(QPen(c.quiet, 1));
    axis.setTickPen(QPen(c.quiet, 1));
    axis.setSubTickPen(Qt::NoPen);
    axis.setTickLabelColor(c.text);
    axis.setLabelColor(c.text);
    axis.setTickLabelFont(small);
    axis.setLabelFont(small);
    axis.grid()->setPen(QPen(c.grid, 1));
    axis.grid()->setZeroLinePen(QPen(c.reference, 1));
    axis.grid()->setSubGridVisible(false);
}

void stylePlot(QCustomPlot& plot) {
    plot.setBackground(QBrush(colours().base));
    for (auto* rect : plot.axisRects()) {
        for (auto* axis : rect->axes()) styleAxis(*axis);
    }
    for (int i = 0; i < plot.itemCount(); ++i) {
        auto* item = plot.item(i);
        if (item->objectName() != "watermark") continue;
        static_cast<QCPItemText*>(item)->setColor(colours().watermark);
    }
}

QCPItemText* addWatermark(QCPAxisRect& axes) {
    auto* plot = axes.parentPlot();
    if (plot->layer("watermark") == nullptr) plot->addLayer("watermark", plot->layer("grid"), QCustomPlot::limAbove);
    auto* item = new QCPItemText(plot);
    item->setObjectName("watermark");
    item->setLayer("watermark");
    item->setClipAxisRect(&axes);
    item->position->setAxisRect(&axes);
    item->position->setType(QCPItemPosition::ptAxisRectRatio);
    item->position->setCoords(0.5, 0.5);
    item->setText(QObject::tr("SIMULATED"));
    item->setRotation(-20);
    item->setSelectable(false);
    auto font = QApplication::font();
    font.setPointSizeF(26);
    font.setBold(true);
    item->setFont(font);
    item->setColor(colours().watermark);
    return item;
}

QWidget* heading(const QString& text, QWidget* parent) {
    auto* label = new QLabel(text, parent);
    auto font = label->font();
    font.setPointSizeF(font.pointSizeF() * 1.3);
    font.setBold(true);
    label->setFont(font);
    return label;
}

QWidget* explanation(const QString& text, QWidget* parent) {
    auto* label = new QLabel(text, parent);
    label->setWordWrap(true);
    label->setForegroundRole(QPalette::PlaceholderText);
    return label;
}

EmptyState::EmptyState(const QString& what, const QString& next, QWidget* parent) : QWidget(parent) {
    auto* layout = new QVBoxLayout(this);
    layout->addStretch();
    auto* label = new QLabel(what, this);
    label->setAlignment(Qt::AlignCenter);
    label->setWordWrap(true);
    auto font = label->font();
    font.setPointSizeF(font.pointSizeF() * 1.15);
    label->setFont(font);
    layout->addWidget(label);
    if (!next.isEmpty()) {
        auto* button = new QPushButton(next, this);
        connect(button, &QPushButton::clicked, this, &EmptyState::nextStep);
        layout->addSpacing(12);
        layout->addWidget(button, 0, Qt::AlignCenter);
    }
    layout->addStretch();
}

}  // namespace tacto::gui
