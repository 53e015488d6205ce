// ActionButtons.h - what can be done with a session, as buttons: each says why it cannot act, and where there is little
// room they are icons, so that the panes beside each other fit.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QBoxLayout>
#include <QPushButton>
#include <functional>
#include <vector>

namespace tacto::gui {

class ActionButtons {
public:
    /// Adds a button to `row`, which owns it as a child of its widget.
    QPushButton* add(QBoxLayout& row, const char* iconName, const QString& text, const QString& tip,
                     std::function<void()> act);
    /// Enabled with an empty `refusal`, else disabled with it as the tool tip.
    void offer(QPushButton* button, const QString& refusal);
    void offerAll(const QString& refusal);
    /// Words or icons, by the room for the panes in pixels: call again when that or the size of text changes.
    void dress(int room);

private:
    struct Action {
        QPushButton* button;
        QString text;
        QString tip;
        QString refusal;
    };
    static void explain(const Action& action);
    std::vector<Action> all_;
};

}  // namespace tacto::gui
