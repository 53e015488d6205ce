// OwnDataHome.h - a data folder without anything of the tests before: no calibration, no session.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QByteArray>
#include <QTemporaryDir>

namespace tacto::test {

/// $XDG_DATA_HOME is a folder of its own while it lives.
class OwnDataHome {
public:
    OwnDataHome() : before_(qgetenv("XDG_DATA_HOME")) { qputenv("XDG_DATA_HOME", folder_.path().toUtf8()); }
    ~OwnDataHome() { qputenv("XDG_DATA_HOME", before_); }
    OwnDataHome(const OwnDataHome&) = delete;
    OwnDataHome& operator=(const OwnDataHome&) = delete;

private:
    const QByteArray before_;
    const QTemporaryDir folder_;
};

}  // namespace tacto::test
