// EntryFields.h - input fields for a file, a folder or a day.
#pragma once

#include <QLineEdit>
#include <QToolButton>
#include <QWidget>

namespace tacto::gui {

/// The path of a folder or file. A path that is too long shows its beginning; the tool tip shows all of it.
class PathField final : public QLineEdit {
public:
    /// `tip`: what the user should enter, shown below the path in the tool tip.
    PathField(const QString& path, const QString& tip, QWidget* parent);
};

/// The path of a folder that will be made, with a button to choose it.
class FolderRow final : public QWidget {
    Q_OBJECT
public:
    /// `tip`: what the user should enter. `question`: the title of the dialog that chooses the folder.
    FolderRow(const QString& path, const QString& tip, const QString& question, QWidget* parent);
    [[nodiscard]] PathField& line() const { return *line_; }
    /// The path without blanks at its ends.
    [[nodiscard]] QString folder() const { return line_->text().trimmed(); }

private:
    PathField* line_;
};

/// A day: typed as 2027-03-01, or chosen in a calendar that the button opens (Alt+Down in the field).
///
/// The owner checks the typed text and reports errors.
class DayField final : public QWidget {
    Q_OBJECT
public:
    /// Names the field `name` and the button "calendar-" plus `name`. An empty field shows `meansEmpty`.
    DayField(const QString& name, const QString& meansEmpty, QWidget* parent);
    [[nodiscard]] QLineEdit& line() const { return *line_; }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    QLineEdit* line_;
    QToolButton* button_;
};

/// Places the line and a button that fills it side by side in `holder`.
void placeInLine(QWidget& holder, QLineEdit& line, QToolButton& button);

}  // namespace tacto::gui
