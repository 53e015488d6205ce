// EntryFields.h - lines in which a file, a folder or a day is entered.
#pragma once

#include <QLineEdit>
#include <QToolButton>
#include <QWidget>

namespace tacto::gui {

/// A folder or file as text: a path without room is read from its beginning; the tool tip has all of it.
class PathField final : public QLineEdit {
public:
    /// `tip`: what is expected, below the path in the tool tip.
    PathField(const QString& path, const QString& tip, QWidget* parent);
};

/// A folder that is to be made: its path as text, and a button that chooses it.
class FolderRow final : public QWidget {
    Q_OBJECT
public:
    /// `tip`: what is expected. `question`: the title of the dialog in which it is chosen.
    FolderRow(const QString& path, const QString& tip, const QString& question, QWidget* parent);
    [[nodiscard]] PathField& line() const { return *line_; }
    /// Blanks trimmed.
    [[nodiscard]] QString folder() const { return line_->text().trimmed(); }

private:
    PathField* line_;
};

/// A day: typed as 2027-03-01, or chosen in a calendar by the button beside it (in the line: Alt+Down).
///
/// Its owner checks what is typed and says what is wrong with it.
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
