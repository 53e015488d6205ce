// Look.h - the window's one look, light and dark: colours by role, plots that share it, digits of equal width.
//
// Widgets take colours from their palette; plots take them from here, and again when the theme changes
// (QEvent::PaletteChange). Conditions have the styles of the reports (conditionStyle()), numbers their text
// (quantityText()).
//
// Thread-safety: the GUI thread.
#pragma once

#include <QApplication>
#include <QColor>
#include <QFont>
#include <QWidget>
#include <qcustomplot.h>

#include "app/report/NumberText.h"
#include "app/report/PlotSheet.h"
#include "core/safety/Interlock.h"

namespace tacto::gui {

enum class Theme { Light, Dark };

/// Sets palette and style of the whole program.
void applyTheme(Theme theme);
[[nodiscard]] Theme currentTheme();
/// Text of the whole program at 100 to 200 % of the desktop's size; anything else is 100. What was already built keeps
/// the room it took: best called before the window is made.
void applyTextSize(int percent);

/// Data carry the colour; everything else is quiet. Contrast of text ≥ 4.5:1 on `base`.
struct Colours {
    QColor base;  ///< of plots and lists
    QColor text;
    QColor quiet;  ///< secondary text, axes
    QColor grid;
    QColor voltage;  ///< #0072B2, lightened on dark
    QColor current;  ///< #009E73
    QColor math;     ///< #CC79A7
    QColor reference;
    QColor accent;     ///< selection, the one button that goes on
    QColor amber;      ///< fill of what is armed, and of a limit from 80 %
    QColor amberText;  ///< words of warning
    QColor fault;      ///< words and marks of faults and broken limits, and nothing else
    QColor good;       ///< a pass: blue, not green, and never without its word
    QColor watermark;
};
[[nodiscard]] const Colours& colours();

/// The condition's style in the current theme ("smooth-low", ...).
[[nodiscard]] ConditionStyle conditionLook(const QString& name, int index = 0);

/// Word, shape and colours of an interlock state; `ink` on `ground` has a contrast of 4.5:1 or more.
struct StateLook {
    QString word;   ///< "DISARMED"
    QString shape;  ///< "◯"
    QColor ground;
    QColor ink;
};
[[nodiscard]] StateLook stateLook(InterlockState state);

/// `font` with digits of equal width (DejaVu Sans has them; this keeps size and weight).
[[nodiscard]] QFont digits(QFont font, double scale = 1);

/// The word that is read from two metres, times the size of text: 28 pt where text has 10.5 pt.
constexpr double kDisplayText = 2.67;

/// Quiet axes of the current theme: call again on a PaletteChange. Fonts follow the application's.
void styleAxis(QCPAxis& axis);
void stylePlot(QCustomPlot& plot);

/// "SIMULATED" across an axis rect, behind the data. Returns the item, to be hidden where nothing is simulated.
QCPItemText* addWatermark(QCPAxisRect& axes);

/// "just now", "2 s ago", "3 min ago"; "–" for NaN.
[[nodiscard]] QString ageText(double seconds);

/// A heading, and a quiet line of explanation that wraps.
[[nodiscard]] QWidget* heading(const QString& text, QWidget* parent = nullptr);
[[nodiscard]] QWidget* explanation(const QString& text, QWidget* parent = nullptr);

/// An empty workspace: what it is for, and a button with the next step. `next` may be empty.
class EmptyState : public QWidget {
    Q_OBJECT
public:
    EmptyState(const QString& what, const QString& next, QWidget* parent = nullptr);
signals:
    void nextStep();
};

}  // namespace tacto::gui
