// ScopeStatus.h - the line above the oscilloscope's screen. Shows the first of these that applies: an error, the
// progress of reading a file, what was saved, the state of the oscilloscope.
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
    /// `model` outlives this. Its lanes are listed in front of the text.
    ScopeStatus(const ScopeModel& model, QWidget* parent);

    /// Sets both sentences; empty for none. They stay until forget() or forgetProblem() is called.
    void tell(const QString& done, const QString& problem);
    void tellProblem(const QString& problem) { tell(done_, problem); }
    void forgetProblem() { problem_.clear(); }
    [[nodiscard]] const QString& problem() const { return problem_; }
    /// Clears both sentences, unless tell() was called in the last few seconds.
    void forget();
    /// `percentRead`: progress of the file being read. `standing`: the state of the oscilloscope.
    void show(std::optional<int> percentRead, const QString& standing);
    using QWidget::show;

signals:
    /// The user cancelled reading the file.
    void cancelClicked();

private:
    QString problem_;
    QString done_;
    QElapsedTimer told_;
    QLabel* text_;
    QToolButton* cancel_;
};

}  // namespace tacto::gui
