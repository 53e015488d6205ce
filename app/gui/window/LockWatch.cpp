#include "app/gui/window/LockWatch.h"

#include <QDBusConnection>
#include <QDBusObjectPath>
#include <QDBusPendingCallWatcher>
#include <QDBusPendingReply>

namespace tacto::gui {

namespace {

constexpr const char* kSavers[] = {"org.freedesktop.ScreenSaver", "org.gnome.ScreenSaver", "org.cinnamon.ScreenSaver",
                                   "org.mate.ScreenSaver", "org.xfce.ScreenSaver"};
constexpr const char* kLogind = "org.freedesktop.login1";
constexpr const char* kLogindSession = "org.freedesktop.login1.Session";
constexpr const char* kDBusProperties = "org.freedesktop.DBus.Properties";

/// Calls `then` with the reply. Does nothing if `owner` is gone or no reply came.
template <class Reply>
void askBus(QObject& owner, const QDBusConnection& bus, const QDBusMessage& call,
            std::function<void(const Reply&)> then) {
    auto* pending = new QDBusPendingCallWatcher(bus.asyncCall(call), &owner);
    QObject::connect(pending, &QDBusPendingCallWatcher::finished, &owner, [then = std::move(then)](auto* watcher) {
        const QDBusPendingReply<Reply> reply = *watcher;
        watcher->deleteLater();
        if (!reply.isError()) then(reply.value());
    });
}

}  // namespace

LockWatch::LockWatch(QObject* parent) : QObject(parent) {
    auto desktop = QDBusConnection::sessionBus();
    if (desktop.isConnected()) {
        for (const auto* saver : kSavers)
            desktop.connect({}, {}, saver, "ActiveChanged", this, SLOT(saverChanged(bool, QDBusMessage)));
    }
    askSession();
}

void LockWatch::askSession() {
    auto system = QDBusConnection::systemBus();
    if (!system.isConnected()) return;
    auto call = QDBusMessage::createMethodCall(kLogind, "/org/freedesktop/login1", "org.freedesktop.login1.Manager",
                                               "GetSession");
    call << QString("auto");  // this program's session, else the user's session with a screen
    askBus<QDBusObjectPath>(*this, system, call, [this](const QDBusObjectPath& path) {
        session_ = path.path();
        auto bus = QDBusConnection::systemBus();
        bus.connect(kLogind, session_, kDBusProperties, "PropertiesChanged", this,
                    SLOT(sessionChanged(QString, QVariantMap, QStringList)));
        auto all = QDBusMessage::createMethodCall(kLogind, session_, kDBusProperties, "GetAll");
        all << QString(kLogindSession);
        askBus<QVariantMap>(*this, bus, all, [this](const QVariantMap& properties) { readSession(properties); });
    });
}

void LockWatch::saverChanged(bool active, const QDBusMessage& message) {
    if (active)
        lockedBy_.insert(message.interface());
    else
        lockedBy_.remove(message.interface());
}

void LockWatch::sessionChanged(const QString& interface, const QVariantMap& changed, const QStringList&) {
    if (interface == kLogindSession) readSession(changed);
}

void LockWatch::readSession(const QVariantMap& properties) {
    locked_ = properties.value("LockedHint", locked_).toBool();
    elsewhere_ = !properties.value("Active", !elsewhere_).toBool();
}

void LockWatch::forget() {
    lockedBy_.clear();
    locked_ = elsewhere_ = false;
}

QString LockWatch::says() const {
    if (locked_ || !lockedBy_.isEmpty()) return tr("the screen was locked");
    return elsewhere_ ? tr("another session was at the screen") : QString();
}

}  // namespace tacto::gui

#include "moc_LockWatch.cpp"
