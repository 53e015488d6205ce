// Theme.h - the window's theme, light and dark: colours by role, plots that share it, digits of equal width.
//
// Widgets take colours from their palette; plots take them from here, and again when the theme changes
// (QEvent::PaletteChange). Conditions have the styles of the reports (conditionStyle()), numbers their text
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
/// Text of the whole program at 100 to 200 % of its size, which is the desktop's and at least 10.5 pt; anything else is
/// 100.
void applyTextSize(int percent);

/// The current theme's.
[[nodiscard]] const Colours& colours();

/// Three sizes of text, and a fourth for one word of a screen: the state, the verdict, the code of a participant.
enum class TextSize { Small, Body, Large, Display };
[[nodiscard]] QFont textFont(TextSize size, QFont::Weight weight = QFont::Normal);
/// The widget's text, kept when the size of text changes.
void setTextSize(QWidget& widget, TextSize size, bool strong = false);
enum class Tone { Text, Quiet, Warning };
/// The colour of a label's words, kept when the theme changes.
void setTone(QLabel& label, Tone tone);
/// `px` at text of 10.5 pt, in the current size of text.
[[nodiscard]] int scaledPx(int px);

/// The filled button of a screen; one that has no edge until the pointer is over it.
void makePrimary(QPushButton& button, bool primary = true);
void makeQuiet(QPushButton& button);
/// While a page yields, its filled button looks like the others: the next step is elsewhere.
void letYield(QWidget& page, bool yields);
/// The bar below a page that holds what can be done with it.
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

/// `font` at `scale` times its size, with digits of equal width (Noto Sans and DejaVu Sans have them).
[[nodiscard]] QFont digits(QFont font, double scale = 1);

/// The word that is read from two metres, times the size of text: 28 pt where text has 10.5 pt.
constexpr double kDisplayText = 28 / 10.5;

/// Quiet axes of the current theme in a closed frame: call again on a PaletteChange. Fonts follow the application's.
void styleAxis(QCPAxis& axis);
void stylePlot(QCustomPlot& plot);

/// "SIMULATED" across an axis rect. Returns the item, to be hidden where nothing is simulated. It stands above grid and
/// fills (layers "grid" and "background") and below the data; or, where they fill the plot, in front as an outline that
/// covers a pixel's width of them.
enum class WatermarkPlace { Behind, InFront };
QCPItemText* addWatermark(QCPAxisRect& axes, WatermarkPlace place = WatermarkPlace::Behind);
/// Shows or hides it, and draws its plot again where that changes it.
void showWatermark(QCPItemText& watermark, bool simulated);

/// "just now", "2 s ago", "3 min ago"; "–" for NaN.
[[nodiscard]] QString ageText(double seconds);

/// A heading, and a quiet line of explanation that wraps.
[[nodiscard]] QWidget* heading(const QString& text, QWidget* parent = nullptr);
[[nodiscard]] QWidget* explanation(const QString& text, QWidget* parent = nullptr);
/// A line between what stands above and below it.
[[nodiscard]] QFrame* lineAcross(QWidget* parent);

/// An empty workspace: what it is for, and a button with the next step. `next` may be empty.
class EmptyState : public QWidget {
    Q_OBJECT
public:
    EmptyState(const QString& what, const QString& next, QWidget* parent = nullptr);
signals:
    void nextStep();
};

/// Calls `follow` from now on whenever `widget` has another palette or another font.
void onLookChange(QWidget& widget, std::function<void()> follow);
/// Calls it when the font changes, and for nothing else.
void onFontChange(QWidget& widget, std::function<void()> follow);

/// Calls `follow` whenever `widget` is shown or gets another size, with what is laid out in it in its new place.
/// `event`: Show or Resize; another, such as Hide, comes also while the widget is destroyed.
void onEvent(QWidget& widget, QEvent::Type event, std::function<void()> follow);

/// Calls `follow` in the next turn of the event loop after a change of palette, font or style, when the widgets within
/// have it too: for one that gives them fonts, places or a style sheet of its own. (The theme's new sheet takes them
/// those fonts; a sheet that is set while the theme's is being laid may keep the colours of the theme before.)
void afterLookChange(QWidget& widget, std::function<void()> follow);

/// Bounds of a widget's width that grow and shrink with the size of text: pixels of text at 100 % (scaledPx()).
void boundWidth(QWidget& widget, int atMost_px);
void fixWidth(QWidget& widget, int px);

}  // namespace tacto::gui
