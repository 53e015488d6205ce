// DayField.h - a day: typed as 2027-03-01, or chosen in a calendar by the button beside it (in the line: Alt+Down).
//
// Its owner checks what is typed and says what is wrong with it.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLineEdit>
#include <QToolButton>
#include <QWidget>

namespace tacto::gui {

class DayField final : public QWidget {
    Q_OBJECT
public:
    /// The line is named `name`, the button "calendar-" and the name. `meansEmpty` stands in a line without a day.
    DayField(const QString& name, const QString& meansEmpty, QWidget* parent);
    [[nodiscard]] QLineEdit& line() const { return *line_; }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    QLineEdit* line_;
    QToolButton* button_;
};

/// The line with a button that fills it, side by side in `holder`.
void placeInLine(QWidget& holder, QLineEdit& line, QToolButton& button);

}  // namespace tacto::gui
