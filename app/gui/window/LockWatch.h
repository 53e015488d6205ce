// LockWatch.h - watches whether the screen is locked or another session is shown, as reported over D-Bus by the desktop
// (org.freedesktop.ScreenSaver and similar names) and by logind.
//
// If the bus or the service is missing, nothing is known and says() is empty. A lock program without D-Bus (i3lock)
// grabs keyboard and mouse: see DisplaySight.
//
// Thread-safety: the GUI thread. Nothing here waits for an answer.
#pragma once

#include <QDBusMessage>
#include <QObject>
#include <QSet>

namespace tacto::gui {

class LockWatch final : public QObject {
    Q_OBJECT
public:
    explicit LockWatch(QObject* parent);
    /// "the screen was locked"; empty if the screen is not locked or nothing is known.
    [[nodiscard]] QString says() const;
    /// The operator has proved to be there: drops earlier reports.
    void forget();

private slots:
    void saverChanged(bool active, const QDBusMessage& message);
    void sessionChanged(const QString& interface, const QVariantMap& changed, const QStringList& invalidated);

private:
    void readSession(const QVariantMap& properties);
    void askSession();

    QSet<QString> lockedBy_;  // active screen savers
    bool locked_ = false;     // logind reports a locked session
    bool elsewhere_ = false;  // the seat shows another session
    QString session_;         // the session's path at logind; empty if there is none
};

}  // namespace tacto::gui
