// MarkLine.h - a line for the word of a mark: the mark's moment is when its key was pressed, however long the typing
// takes.
//
// It lies over the lower edge of the workspace, so that nothing moves, and is not a dialog: all keys that stop do so in
// it, and Esc closes it too. Return marks; a line left empty marks without a word of its own.
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
    /// `over`: the widget at whose lower edge it lies, above `notice` while that is there.
    MarkLine(BenchController& controller, RecordingLine& line, QWidget& over, QWidget& notice);
    /// Takes this moment, and asks for its word; a line that is still open marks the earlier moment. Where nothing is
    /// recorded it says so by refused().
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
    std::filesystem::path session_;  ///< the session that holds the moment
    QPointer<QWidget> focusBefore_;
};

}  // namespace tacto::gui
