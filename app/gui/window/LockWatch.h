// LockWatch.h - whether the screen is locked, or another session has it: what the desktop (org.freedesktop.ScreenSaver
// and the names that desktops have for it) and logind say over D-Bus.
//
// Where the bus or the service is missing, nothing is said, and says() is empty. A lock program without D-Bus (i3lock)
// takes keyboard and mouse: see DisplaySight.
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
    /// "the screen was locked"; empty while it is not, or where it is not known.
    [[nodiscard]] QString says() const;
    /// The operator is there after all: earlier reports do not count any longer.
    void forget();

private slots:
    void saverChanged(bool active, const QDBusMessage& message);
    void sessionChanged(const QString& interface, const QVariantMap& changed, const QStringList& invalidated);

private:
    void readSession(const QVariantMap& properties);
    void askSession();

    QSet<QString> lockedBy_;  // screen savers that are active
    bool locked_ = false;     // logind says that it is locked
    bool elsewhere_ = false;  // another session is at the seat
    QString session_;         // the session's path at logind; empty where there is none
};

}  // namespace tacto::gui
