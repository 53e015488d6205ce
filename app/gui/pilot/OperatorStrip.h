// OperatorStrip.h - the operator's page on a single screen: a strip at the lower edge of the participant's window,
// opened by F2. While the strip is open no presentation starts.
#pragma once

#include <QFrame>
#include <QLabel>
#include <QPushButton>

#include "app/gui/pilot/OperatorAsk.h"
#include "app/gui/pilot/SessionNotes.h"

namespace tacto::gui {

class OperatorStrip final : public QFrame {
    Q_OBJECT
public:
    explicit OperatorStrip(QWidget* parent = nullptr);
    void setWhere(const QString& where);
    void setBreakDue(bool due);
    [[nodiscard]] OperatorAsk& question() { return *ask_; }
    [[nodiscard]] SessionNotes& notes() { return *notes_; }

signals:
    void breakWanted(bool due);
    void stopWanted();  ///< emitted when the press goes down
    void abortWanted();
    void closeWanted();

private:
    QLabel* where_;
    OperatorAsk* ask_;
    SessionNotes* notes_;
    QPushButton* break_;
    bool due_ = false;
};

}  // namespace tacto::gui
