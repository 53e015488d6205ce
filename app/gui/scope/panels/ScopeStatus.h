// ScopeStatus.h - the line over the oscilloscope's screen: what went wrong, how far a file is read, what was saved, or
// how the oscilloscope stands; the first of them that there is.
#pragma once

#include <QElapsedTimer>
#include <QString>
#include <QWidget>
#include <optional>

class QLabel;
class QToolButton;

namespace tacto::gui {

class ScopeModel;

class ScopeStatus final : public QWidget {
    Q_OBJECT
public:
    /// `model` outlives this: its lanes stand before the words.
    ScopeStatus(const ScopeModel& model, QWidget* parent);

    /// Sentences; empty for nothing. They stay until they are forgotten, and long enough to be read.
    void tell(const QString& done, const QString& problem);
    void tellProblem(const QString& problem) { tell(done_, problem); }
    void forgetProblem() { problem_.clear(); }
    [[nodiscard]] const QString& problem() const { return problem_; }
    /// Does nothing in the first seconds.
    void forget();
    /// `percentRead`: of the file that is being read. `standing`: how the oscilloscope stands.
    void show(std::optional<int> percentRead, const QString& standing);
    using QWidget::show;

signals:
    /// The file is to be read no further.
    void cancelClicked();

private:
    QString problem_;
    QString done_;
    QElapsedTimer told_;
    QLabel* text_;
    QToolButton* cancel_;
};

}  // namespace tacto::gui
