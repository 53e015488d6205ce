#include "app/gui/theme/Colours.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "app/report/Ink.h"

namespace tacto::gui {

namespace {

const Colours kLight{.window = ink::kWindow,
                     .base = "#FFFFFF",
                     .sunken = ink::kSunken,
                     .selection = "#DDE3EA",
                     .line = ink::kLine,
                     .edge = "#858E9A",
                     .text = ink::kText,
                     .quiet = ink::kQuiet,
                     .primary = "#1F262E",
                     .primaryText = "#FFFFFF",
                     .voltage = ink::kVoltage,
                     .current = ink::kCurrent,
                     .currentText = "#00795A",
                     .third = ink::kThird,
                     .grid = ink::kGrid,
                     .zero = "#B4BBC4",
                     .frame = ink::kAxis,
                     .amber = ink::kAmber,
                     .amberInk = "#1A1F25",
                     .amberText = ink::kAmberText,
                     .amberCell = ink::kAmberCell,
                     .delivering = "#0072B2",
                     .stop = ink::kFault,
                     .fault = ink::kFault,
                     .banner = "#FCECEC",
                     .pass = ink::kPass,
                     .passText = ink::kPass,
                     .passCell = "#E3F2EE",
                     .fail = ink::kFail,
                     .failText = "#FFFFFF",
                     .hatch = ink::kHatch,
                     .bar = ink::kBar,
                     .watermark = QColor(0x1A, 0x1F, 0x25, 15)};

const Colours kDark{.window = "#14171B",
                    .base = "#1B1F24",
                    .sunken = "#23282E",
                    .selection = "#2E353E",
                    .line = "#363D46",
                    .edge = "#7A8490",
                    .text = "#E9ECEF",
                    .quiet = "#A9B2BC",
                    .primary = "#E4E8EC",
                    .primaryText = "#14171B",
                    .voltage = "#56B4E9",
                    .current = "#27C498",
                    .currentText = "#27C498",
                    .third = "#DB8DBB",
                    .grid = "#272D34",
                    .zero = "#4A535E",
                    .frame = "#8B95A1",
                    .amber = "#F0AE1D",
                    .amberInk = "#14171B",
                    .amberText = "#F5C558",
                    .amberCell = "#3A2D10",
                    .delivering = "#0072B2",
                    .stop = "#D0202B",
                    .fault = "#FF7A7F",
                    .banner = "#35191C",
                    .pass = "#00735C",
                    .passText = "#2FBF9A",
                    .passCell = "#16302A",
                    .fail = "#E4E8EC",
                    .failText = "#14171B",
                    .hatch = "#5A636E",
                    .bar = "#8B95A1",
                    .watermark = QColor(255, 255, 255, 14)};

double luminance(const QColor& colour) {
    const auto linear = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
    return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) + 0.0722 * linear(colour.blueF());
}

}  // namespace

double contrast(const QColor& a, const QColor& b) {
    const auto [low, high] = std::minmax({luminance(a), luminance(b)});
    return (high + 0.05) / (low + 0.05);
}

QColor legible(QColor ink, const QColor& paper) {
    constexpr double kWords = 4.5;
    constexpr int kStep = 105, kMaxSteps = 40;  // percent
    const bool darker = contrast(paper, Qt::black) > contrast(paper, Qt::white);
    for (int i = 0; i < kMaxSteps && contrast(ink, paper) < kWords; ++i)
        ink = darker ? ink.darker(kStep) : ink.lighter(kStep);
    return ink;
}

const Colours& coloursOf(Theme theme) { return theme == Theme::Dark ? kDark : kLight; }

QPalette paletteOf(const Colours& c) {
    QPalette p;
    const std::pair<QPalette::ColorRole, QColor> roles[] = {
        {QPalette::Window, c.window},
        {QPalette::WindowText, c.text},
        {QPalette::Base, c.base},
        {QPalette::AlternateBase, c.window},
        {QPalette::Text, c.text},
        {QPalette::PlaceholderText, c.quiet},
        {QPalette::Button, c.base},
        {QPalette::ButtonText, c.text},
        {QPalette::BrightText, c.fault},
        {QPalette::Highlight, c.selection},
        {QPalette::HighlightedText, c.text},
        {QPalette::ToolTipBase, c.base},
        {QPalette::ToolTipText, c.text},
        {QPalette::Link, c.voltage},
        {QPalette::LinkVisited, c.voltage},
        {QPalette::Mid, c.line},
        {QPalette::Midlight, c.sunken},
        {QPalette::Dark, c.edge},
        {QPalette::Light, c.base},
        {QPalette::Shadow, c.frame},
    };
    for (const auto& [role, colour] : roles) p.setColor(role, colour);
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
        p.setColor(QPalette::Disabled, role, c.edge);
    return p;
}

namespace {

constexpr double kDesigned_pt = 10.5;  // text size for which the lengths below are designed

constexpr const char* kSheet = R"(
QMainWindow, QDialog { background: @window; }
QMainWindow::separator { background: @line; width: 1px; height: 1px; }
QToolTip { background: @base; color: @text; border: 1px solid @edge; padding: 4px; }

QMenuBar { background: @window; border-bottom: 1px solid @line; }
QMenuBar::item { padding: 4px 12px; background: transparent; }
QMenuBar::item:selected { background: @selection; }
QMenu { background: @base; border: 1px solid @edge; padding: 4px 0; }
QMenu::item { padding: 5px 24px 5px 28px; }
QMenu::item:selected { background: @selection; }
QMenu::item:disabled { color: @edge; }
QMenu::separator { height: 1px; background: @line; margin: 4px 0; }

QToolBar { background: @window; border: none; spacing: 0; padding: 0; }
QToolBar#workspaces { border-right: 1px solid @line; }
QToolBar#workspaces > QToolButton { border: none; border-left: 4px solid transparent; border-radius: 0;
    padding: ~6 ~8 ~6 ~4; }
QToolBar#workspaces > QToolButton[toolButtonStyle="0"] { padding: 8px 6px 8px 2px; }
QToolBar#workspaces > QToolButton[toolButtonStyle="3"] { min-width: ~76; }
QToolBar#workspaces > QToolButton:checked { background: @selection; border-left-color: @primary; }
QToolBar#workspaces > QToolButton:focus { border: 2px solid @text; border-left: 4px solid @text; }
QToolBar#safetyToolBar { border-bottom: 1px solid @line; }
QStatusBar { background: @window; border-top: 1px solid @line; color: @quiet; }
QStatusBar::item { border: none; }
QStatusBar QLabel, QStatusBar QToolButton { font-size: ^9; color: @quiet; }
QStatusBar QLabel { border: none; padding: 0 ~4; min-height: ~20; }
QStatusBar QToolButton { border: 2px solid transparent; padding: 0 ~2; min-height: ~16; }
QStatusBar QToolButton:focus { border: 2px solid @text; padding: 0 ~2; }

QPushButton { background: @base; border: 1px solid @edge; border-radius: 4px; padding: 0 ~11; min-height: ~30; }
QPushButton:hover { background: @sunken; }
QPushButton:pressed, QPushButton:checked { background: @selection; }
QPushButton:disabled { color: @edge; border-color: @line; }
QPushButton:focus { border: 2px solid @text; padding: 0 ~10; min-height: ~28; }
QPushButton[role="primary"] { background: @primary; color: @primaryText; border-color: @primary; }
QPushButton[role="primary"]:hover { background: @frame; }
QPushButton[role="primary"]:disabled { background: @sunken; color: @edge; border-color: @line; }
QPushButton[role="primary"]:focus { border: 2px solid @voltage; }
*[yields="true"] QPushButton[role="primary"]:enabled { background: @base; color: @text; border-color: @edge; }
*[yields="true"] QPushButton[role="primary"]:enabled:hover { background: @sunken; }
QPushButton[role="quiet"] { background: transparent; border-color: transparent; }
QPushButton[role="quiet"]:hover { background: @sunken; }
QPushButton[role="quiet"]:focus { border-color: @text; }
QPushButton[role="segment"] { border-radius: 0; padding: 0 ~6; margin-left: -1px; }
QPushButton[role="segment"][first="true"] { margin-left: 0; }
QPushButton[role="segment"]:checked { background: @primary; color: @primaryText; border-color: @primary; }
QPushButton[role="segment"]:checked:disabled { background: @sunken; color: @edge; border-color: @line; }
QPushButton::menu-indicator { image: url(:/icons/controls/down.svg); width: ~10; height: ~10; right: ~6;
    subcontrol-origin: padding; subcontrol-position: center right; }

QToolButton { border: 1px solid transparent; border-radius: 4px; padding: 4px; background: transparent;
    icon-size: ~16; }
QToolButton:hover { background: @sunken; }
QToolButton:pressed, QToolButton:checked { background: @selection; border-color: @line; }
QToolButton:focus { border: 2px solid @text; padding: 3px; }
QMenuBar QToolButton { padding: 5px ~8; }
QMenuBar QToolButton:focus { padding: 4px ~8; }
QToolButton:disabled { color: @edge; }
QToolButton[role="opens"]::menu-indicator { image: none; width: 0; }
QToolButton[role="row"] { padding: 1px 0; }
QToolButton[role="row"]:focus { padding: 0; border-width: 2px 1px; }
QToolButton[popupMode="1"] { padding-right: ~16; }
QToolButton::menu-button { border: none; width: ~14; }
QToolButton::menu-arrow, QToolButton::menu-indicator { image: url(:/icons/controls/down.svg); width: ~10; height: ~10; }

QLineEdit, QAbstractSpinBox, QComboBox, QPlainTextEdit, QTextEdit, QListView, QTreeView, QTableView {
    background: @base; color: @text; selection-background-color: @selection; selection-color: @text; }
QLineEdit, QAbstractSpinBox, QComboBox { border: 1px solid @edge; border-radius: 4px; min-height: ~28; }
QLineEdit { padding: 0 ~8; }
QAbstractSpinBox { padding-left: ~8; padding-right: ~4; }
QComboBox { padding: 0 ~4 0 ~10; }
QLineEdit:focus, QAbstractSpinBox:focus, QComboBox:focus { border: 2px solid @text; min-height: ~26; }
QLineEdit:disabled, QAbstractSpinBox:disabled, QComboBox:disabled { color: @edge; border-color: @line; }
QLineEdit:read-only { background: @window; border-color: @line; }
QAbstractSpinBox QLineEdit, QComboBox QLineEdit { border: none; padding: 0; min-height: 0; background: transparent; }
QAbstractSpinBox::up-button, QAbstractSpinBox::down-button { border: none; background: transparent; width: ~18; }
QAbstractSpinBox::up-button:hover, QAbstractSpinBox::down-button:hover { background: @sunken; }
QAbstractSpinBox::up-button { subcontrol-origin: border; subcontrol-position: top right; margin: 2px 2px 0 0; }
QAbstractSpinBox::down-button { subcontrol-origin: border; subcontrol-position: bottom right; margin: 0 2px 2px 0; }
QAbstractSpinBox::up-arrow { image: url(:/icons/controls/up.svg); width: ~9; height: ~9; }
QAbstractSpinBox::down-arrow { image: url(:/icons/controls/down.svg); width: ~9; height: ~9; }
QAbstractSpinBox::up-arrow:off, QAbstractSpinBox::down-arrow:off { image: none; }
QComboBox::drop-down { border: none; width: ~24; }
QComboBox::down-arrow { image: url(:/icons/controls/down.svg); width: ~11; height: ~11; }
QComboBox QAbstractItemView { border: 1px solid @edge; outline: none; }

QPlainTextEdit, QTextEdit, QsciScintilla { border: 1px solid @edge; border-radius: 4px; }
QPlainTextEdit:focus, QTextEdit:focus, QsciScintilla:focus { border: 2px solid @text; }
QTextEdit#whatHappened { border: 2px solid transparent; background: transparent; }
QTextEdit#whatHappened:focus { border-color: @text; }

QCheckBox, QRadioButton { spacing: ~8; }
QCheckBox::indicator, QGroupBox::indicator, QTreeView::indicator, QListView::indicator, QTableView::indicator {
    width: ~14; height: ~14; border: 1px solid @edge; border-radius: 3px; background: @base; }
QCheckBox::indicator:checked, QGroupBox::indicator:checked, QTreeView::indicator:checked,
QListView::indicator:checked, QTableView::indicator:checked {
    background: @primary; border-color: @primary; image: url(:/icons/controls/tick-@theme.svg); }
QCheckBox::indicator:disabled, QRadioButton::indicator:disabled { border-color: @line; }
QCheckBox::indicator:checked:disabled { background: @edge; border-color: @edge; }
QCheckBox::indicator:focus, QRadioButton::indicator:focus { border: 2px solid @text; width: ~12; height: ~12; }
QRadioButton::indicator { width: ~14; height: ~14; border: 1px solid @edge; border-radius: ~7; background: @base; }
QRadioButton::indicator:checked { border: ~5 solid @primary; width: ~6; height: ~6; }
QCheckBox:disabled, QRadioButton:disabled { color: @edge; }

QSlider:horizontal { min-height: ~20; }
QSlider::groove:horizontal { height: ~4; background: @sunken; border: 1px solid @line; border-radius: 2px; }
QSlider::sub-page:horizontal { background: @edge; border-radius: 2px; }
QSlider::sub-page:horizontal:disabled { background: @line; }
QSlider::handle:horizontal { width: ~12; margin: -~6 0; border: 2px solid @edge; border-radius: ~8;
    background: @base; }
QSlider::handle:horizontal:focus { border-color: @text; }
QSlider::handle:horizontal:disabled { border-color: @line; }

QProgressBar { background: @sunken; border: 1px solid @line; text-align: center; min-height: ~16; }
QProgressBar::chunk { background: @bar; }

QWidget#tabRow { background: @window; border-bottom: 1px solid @line; }
QTabWidget::pane { border: none; border-top: 1px solid @line; }
QTabBar { background: @window; qproperty-drawBase: 0; outline: none; }
QTabBar::tab { background: @window; color: @quiet; border: none; border-right: 1px solid transparent;
    border-top: 3px solid transparent; padding: 0 ~16; min-height: ~37; }
QTabBar::tab:selected { background: @base; color: @text; border-top-color: @primary; border-right-color: @line;
    font-weight: 600; }
QWidget#tabRow QTabBar::tab:!selected { border-bottom: 1px solid @line; min-height: ~36; }
QTabBar::tab:next-selected { border-right-color: @line; }
QTabBar::tab:hover:!selected { background: @sunken; }
QTabBar::tab:disabled { color: @edge; }
QTabBar::tab:focus { text-decoration: underline; }

QHeaderView { background: @window; border: none; }
QHeaderView::section { background: @window; color: @quiet; border: none; border-bottom: 1px solid @line;
    padding: 0 ~8; min-height: ~28; text-align: left; }
QTableView, QTreeView, QListView { border: 1px solid @line; outline: none; gridline-color: @line;
    alternate-background-color: @base; }
QTableView#sessionsTable { border: none; border-top: 1px solid @line; }
QTableView#sessionsTable QHeaderView::section:first { padding-left: 16px; }
QTableView#limitMatrix QHeaderView::section { padding: 0 ~2; }
QTableView#limitMatrix QHeaderView::section:first { padding-left: ~8; }
QTableView::item, QTreeView::item { border-bottom: 1px solid @grid; padding: 0 ~4; }
QTableView::item:selected, QTreeView::item:selected, QListView::item:selected {
    background: @selection; color: @text; }
QTableView { qproperty-showGrid: 0; }
QTableCornerButton::section { background: @window; border: none; }

QGroupBox { border: none; margin-top: ~24; padding: 0; font-weight: 600; }
QGroupBox::title { subcontrol-origin: margin; subcontrol-position: top left; padding: 0; left: -2px; }

QScrollArea { border: none; }
QScrollBar { background: transparent; border: none; margin: 0; }
QScrollBar:vertical { width: 10px; }
QScrollBar:horizontal { height: 10px; }
QScrollBar::handle { background: @edge; border-radius: 3px; margin: 2px; min-width: 24px; min-height: 24px; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
QSplitter::handle { background: @line; }
QSplitter#judgedLimits::handle { background: transparent; }
QSplitter::handle:horizontal { width: 1px; }
QSplitter::handle:vertical { height: 1px; }

QDockWidget { border: none; }
QDialogButtonBox { dialogbuttonbox-buttons-have-icons: 0; }
QLabel[tone="quiet"] { color: @quiet; }
QLabel[tone="warning"] { color: @amberText; }
*[textSize="small"] { font-size: ^9; }
*[textSize="large"] { font-size: ^15; font-weight: 600; }
*[textSize="display"] { font-size: ^28; font-weight: 700; }
*[textWeight="strong"] { font-weight: 600; }
QWidget#path { background: @window; }
QWidget[role="actions"] { background: @window; border-top: 1px solid @line; }
QFrame#safetyBar, QWidget#centre { background: @base; }
QFrame#tour { background: @base; border: 2px solid @text; border-radius: 4px; }
)";

/// Replaces "~12" by 12 px and "^12" by 12 pt, both scaled from the designed text size.
QString scaled(const QString& sheet, double scale) {
    QString out;
    out.reserve(sheet.size());
    for (qsizetype i = 0; i < sheet.size(); ++i) {
        const bool points = sheet[i] == '^';
        if (sheet[i] != '~' && !points) {
            out += sheet[i];
            continue;
        }
        int number = 0;
        while (i + 1 < sheet.size() && sheet[i + 1].isDigit()) number = number * 10 + sheet[++i].digitValue();
        out += points ? QString::number(number * scale, 'f', 2) + "pt"
                      : QString::number(std::lround(number * scale)) + "px";
    }
    return out;
}

}  // namespace

QString styleSheetOf(Theme theme, const QFont& text) {
    const auto& c = coloursOf(theme);
    const std::pair<const char*, QString> roles[] = {
        // If one name begins with another, the longer name must come first.
        {"@primaryText", c.primaryText.name()},
        {"@primary", c.primary.name()},
        {"@window", c.window.name()},
        {"@amberText", c.amberText.name()},
        {"@base", c.base.name()},
        {"@bar", c.bar.name()},
        {"@sunken", c.sunken.name()},
        {"@selection", c.selection.name()},
        {"@line", c.line.name()},
        {"@edge", c.edge.name()},
        {"@quiet", c.quiet.name()},
        {"@frame", c.frame.name()},
        {"@grid", c.grid.name()},
        {"@voltage", c.voltage.name()},
        {"@theme", theme == Theme::Dark ? "dark" : "light"},
        {"@text", c.text.name()},
    };
    auto sheet = scaled(kSheet, text.pointSizeF() / kDesigned_pt);
    for (const auto& [name, value] : roles) sheet.replace(name, value);
    return sheet;
}

}  // namespace tacto::gui
