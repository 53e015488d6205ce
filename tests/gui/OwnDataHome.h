// OwnDataHome.h - an empty data folder without calibrations and sessions of earlier tests.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QByteArray>
#include <QTemporaryDir>

namespace tacto::test {

/// Sets $XDG_DATA_HOME to a new folder for its lifetime.
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
