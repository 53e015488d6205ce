// Hdf5Export.h - a session as one HDF5 file in netCDF-4's layout, which h5py, MATLAB's h5read, xarray and ncdump open:
//
//   /streams/KIND/{time, CHANNEL...}   /captures/NAME/{time, voltage, current}
//   /trials, /trains, /events, /records with time and a data set for each column of the CSV
//
// What is absent is NaN or an empty text. Each data set has units, long_name and simulated.
//
// Thread-safety: pure functions.
#pragma once

#include "core/exchange/Export.h"

namespace tacto {

[[nodiscard]] const ExportFormat& hdf5Export();

}  // namespace tacto
