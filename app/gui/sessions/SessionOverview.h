// SessionOverview.h - the chosen session at a glance: how it ended and why, who and what, to be edited in place, its
// main plot, and what happened in it.
//
// An edit is kept in the session when the field is left or Return is pressed; what the session refuses is said, and
// stays in the field.
//
// Thread-safety: the GUI thread; saving happens beside it.
#pragma once

#include <QLabel>
#include <QLineEdit>
#include <QTextBrowser>
#include <memory>

#include "app/gui/controller/SideWork.h"
#include "app/gui/sessions/ReadSession.h"

namespace tacto::gui {

class SessionPreview;

class SessionOverview final : public QWidget {
    Q_OBJECT
public:
    explicit SessionOverview(QWidget* parent = nullptr);
    /// Keeps what was edited of the one before.
    void show(std::shared_ptr<const ReadSession> session);
    void say(const QString& why);

signals:
    void labelsSaved(const QString& session);
    /// Labels of a session that is no longer shown could not be saved. `why` is a sentence.
    void labelsRefused(const QString& why);

protected:
    void changeEvent(QEvent* event) override;
    void hideEvent(QHideEvent* event) override;

private:
    void fitWhy();
    [[nodiscard]] QWidget* buildHead();
    [[nodiscard]] QWidget* buildFields();
    [[nodiscard]] QWidget* buildHappened();
    void showHead();
    void showFields();
    void showLabels(const SessionLabels& labels);
    void showHappened();
    void save();
    void saved(const SessionLabels& before, const SessionLabels& edited, const Result<SessionLabels>& done);
    void saySaved(const QString& text, bool refused);
    [[nodiscard]] SessionLabels entered() const;

    std::shared_ptr<const ReadSession> session_;
    SessionLabels kept_;  ///< the labels in the session, or on their way into it
    QString refused_;     ///< why an edit that still stands in the fields is not in the session
    int pending_ = 0;     ///< edits of this session on their way
    SideWork saves_;      ///< edits follow each other; its end waits: what was typed is kept
    QWidget* content_;
    QLabel* nothing_;
    QLabel* icon_ = nullptr;
    QLabel* title_ = nullptr;
    QLabel* why_ = nullptr;
    QString whole_;  ///< the text of why_, before it is elided
    QLineEdit* operator_ = nullptr;
    QLineEdit* sample_ = nullptr;
    QLineEdit* tags_ = nullptr;
    QLineEdit* note_ = nullptr;
    QLabel* saved_ = nullptr;
    SessionPreview* preview_ = nullptr;
    QTextBrowser* happened_ = nullptr;
};

}  // namespace tacto::gui
