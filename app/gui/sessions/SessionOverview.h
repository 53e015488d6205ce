// SessionOverview.h - overview of the chosen session: its result and reason, its labels (which can be edited here), its
// main plot, and a list of events.
//
// An edit is saved in the session when the field is left or Return is pressed; if the session refuses an edit, the
// reason is shown and the text stays in the field.
//
// Thread-safety: the GUI thread; saving runs on another thread.
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
    /// Shows another session, after saving the edits of the previous one.
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
    SessionLabels kept_;  ///< the labels in the session, or being saved to it
    QString refused_;     ///< why an edit still in the fields is not in the session
    int pending_ = 0;     ///< number of edits of this session being saved
    SideWork saves_;      ///< saves edits one after the other; waits for them at the end, so that none is lost
    QWidget* content_;
    QLabel* nothing_;
    QLabel* icon_ = nullptr;
    QLabel* title_ = nullptr;
    QLabel* why_ = nullptr;
    QString whole_;  ///< the full text of why_, before eliding
    QLineEdit* operator_ = nullptr;
    QLineEdit* sample_ = nullptr;
    QLineEdit* tags_ = nullptr;
    QLineEdit* note_ = nullptr;
    QLabel* saved_ = nullptr;
    SessionPreview* preview_ = nullptr;
    QTextBrowser* happened_ = nullptr;
};

}  // namespace tacto::gui
