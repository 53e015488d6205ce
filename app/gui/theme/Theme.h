// Theme.h - the window's theme, light or dark: colours by purpose, plots in the same colours, digits of equal width.
//
// Widgets take their colours from the palette; plots take them from here, again after each change of theme
// (QEvent::PaletteChange). Conditions look as in the reports (conditionStyle()); numbers are written as in the reports
// (quantityText()).
#pragma once

#include <QApplication>
#include <QEvent>
#include <QFont>
#include <QLabel>
#include <QPushButton>
#include <QWidget>
#include <functional>
#include <qcustomplot.h>

#include "app/gui/theme/Colours.h"
#include "app/report/NumberText.h"
#include "app/report/PlotSheet.h"
#include "core/safety/Interlock.h"

namespace tacto::gui {

/// Sets palette, style sheet and font of the whole program.
void applyTheme(Theme theme);
[[nodiscard]] Theme currentTheme();
/// Sets the text size of the whole program to 100 to 200 % of the desktop's, which counts as at least 10.5 pt; any
/// other value means 100 %.
void applyTextSize(int percent);

/// The colours of the current theme.
[[nodiscard]] const Colours& colours();

/// Three text sizes, and a fourth for the one large word of a screen: the state, the verdict, a participant's code.
enum class TextSize { Small, Body, Large, Display };
[[nodiscard]] QFont textFont(TextSize size, QFont::Weight weight = QFont::Normal);
/// Sets a widget's text size, which stays set when the program's text size changes.
void setTextSize(QWidget& widget, TextSize size, bool strong = false);
enum class Tone { Text, Quiet, Warning };
/// Sets the colour of a label's text, which stays set when the theme changes.
void setTone(QLabel& label, Tone tone);
/// Scales `px`, designed for 10.5 pt text, to the current text size.
[[nodiscard]] int scaledPx(int px);

/// Makes the filled button of a screen; makeQuiet() makes a button without an edge until the pointer is over it.
void makePrimary(QPushButton& button, bool primary = true);
void makeQuiet(QPushButton& button);
/// While a page yields, its filled button looks like the others, because the next step is elsewhere.
void letYield(QWidget& page, bool yields);
/// The bar below a page with the page's buttons.
void makeActionBar(QWidget& bar);
[[nodiscard]] bool isActionBar(const QWidget& widget);

/// The condition's style in the current theme ("smooth-low", ...).
[[nodiscard]] ConditionStyle conditionInTheme(const QString& name, int index = 0);

/// Word, shape and colours of an interlock state; `ink` on `ground` has a contrast of 4.5:1 or more.
struct StateStyle {
    QString word;   ///< "DISARMED"
    QString shape;  ///< "◯"
    QString icon;   ///< "state-disarmed"
    QColor ground;
    QColor ink;
};
[[nodiscard]] StateStyle stateStyle(InterlockState state);

/// Returns `font` at `scale` times its size, with digits of equal width (Noto Sans and DejaVu Sans have them).
[[nodiscard]] QFont digits(QFont font, double scale = 1);

/// Size of a word to be read from two metres, relative to the text: 28 pt for 10.5 pt text.
constexpr double kDisplayText = 28 / 10.5;

/// Gives axes the theme's quiet look in a closed frame. Call again on a PaletteChange. Fonts follow the application's.
void styleAxis(QCPAxis& axis);
void stylePlot(QCustomPlot& plot);

/// Writes "SIMULATED" across an axis rect. Returns the item; hide it if nothing is simulated. Behind: above grid and
/// fills (layers "grid" and "background") but below the data. InFront: an outline of one pixel over the data, for data
/// that fill the plot.
enum class WatermarkPlace { Behind, InFront };
QCPItemText* addWatermark(QCPAxisRect& axes, WatermarkPlace place = WatermarkPlace::Behind);
/// Shows or hides the watermark, and redraws its plot if that changes anything.
void showWatermark(QCPItemText& watermark, bool simulated);

/// Returns an age as text: "just now", "2 s ago", "3 min ago"; "–" for NaN.
[[nodiscard]] QString ageText(double seconds);

/// Make a heading, and a quiet explanation that wraps.
[[nodiscard]] QWidget* heading(const QString& text, QWidget* parent = nullptr);
[[nodiscard]] QWidget* explanation(const QString& text, QWidget* parent = nullptr);
/// A horizontal separating line.
[[nodiscard]] QFrame* lineAcross(QWidget* parent);

/// The page of an empty workspace: its purpose, and a button for the next step. `next` may be empty.
class EmptyState : public QWidget {
    Q_OBJECT
public:
    EmptyState(const QString& what, const QString& next, QWidget* parent = nullptr);
signals:
    void nextStep();
};

/// Calls `follow` whenever the palette or font of `widget` changes.
void onLookChange(QWidget& widget, std::function<void()> follow);
/// Calls `follow` whenever the font of `widget` changes.
void onFontChange(QWidget& widget, std::function<void()> follow);

/// Calls `follow` whenever `widget` is shown or resized, after its contents were laid out. `event`: Show or Resize.
/// Other events, such as Hide, also come while the widget is being destroyed.
void onEvent(QWidget& widget, QEvent::Type event, std::function<void()> follow);

/// Calls `follow` in the next turn of the event loop after a change of palette, font or style, when the widgets inside
/// have changed too. For widgets that set fonts, places or a style sheet on their contents: the theme's new sheet
/// removes such fonts, and a sheet set during the change may keep the colours of the old theme.
void afterLookChange(QWidget& widget, std::function<void()> follow);

/// Limits a widget's width in pixels for text at 100 %; the limits grow and shrink with the text size (scaledPx()).
void boundWidth(QWidget& widget, int atMost_px);
void fixWidth(QWidget& widget, int px);

}  // namespace tacto::gui
