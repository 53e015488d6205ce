// MarkLine.h - an input line for the word of a mark. The mark's time is the moment its key was pressed, however long
// the typing takes.
//
// Lies over the lower edge of the workspace, so that nothing moves. It is not a dialog: all stop keys work in it, and
// Esc also closes it. Return marks; an empty line gives the standard word.
#pragma once

#include <QFrame>
#include <QLabel>
#include <QLineEdit>
#include <QPointer>

#include "app/gui/controller/BenchController.h"

namespace tacto::gui {

class RecordingLine;

class MarkLine final : public QFrame {
    Q_OBJECT
public:
    /// `over`: the widget at whose lower edge the line lies; above `notice` while that is shown.
    MarkLine(BenchController& controller, RecordingLine& line, QWidget& over, QWidget& notice);
    /// Notes the present moment and asks for its word. If the line is still open, marks its earlier moment first. If
    /// nothing is being recorded, emits refused().
    void begin();

signals:
    void refused(const QString& why);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    void finish();
    void leave();
    void lieDown();

    BenchController& controller_;
    RecordingLine& line_;
    QWidget& over_;
    QWidget& notice_;
    QLabel* when_;
    QLineEdit* word_;
    Instant at_{0};
    std::filesystem::path session_;  ///< the session in which the moment lies
    QPointer<QWidget> focusBefore_;
};

}  // namespace tacto::gui
