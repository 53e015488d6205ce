// Samples.h - reports and figures for tests, from a separability run as a bench would measure it.
//
// Thread-safety: the test's own thread.
#pragma once

#include <QByteArray>
#include <QJsonObject>
#include <filesystem>
#include <string>

#include "app/report/ReportModel.h"

namespace tacto::test {

/// Trials of a separability run with `repeats` per condition; below, its conditions, captures and confusion.
QJsonObject planeJson(int repeats);
QJsonObject conditionsJson();
QJsonObject waveformsJson();
QJsonObject confusionJson();
QJsonObject exposureJson();
QJsonObject timelineJson(int frames);

/// A figure of `type` with nothing to draw.
QJsonObject emptyFigureJson(const QString& type);

/// Returns the figure as SVG.
std::string drawn(const QJsonObject& figure, bool simulated);

/// Returns a whole report with a figure of every type and two tables.
ReportModel separabilityModel(bool simulated, int repeats = 25);

/// Runs a program of poppler-utils on a PDF; returns its output, such as the text, or an empty text if it fails.
std::string poppler(const std::string& command, const std::filesystem::path& pdf);
bool havePoppler();
inline constexpr const char* kNoPoppler = "poppler-utils is not installed: the PDF is not looked into";

QByteArray contentOfFile(const std::filesystem::path& path);

}  // namespace tacto::test
