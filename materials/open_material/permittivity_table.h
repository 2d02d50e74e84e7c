// Permittivity of a material from an electromagnetic properties table (`_emp.xompt`) of ASAM
// OpenMATERIAL 3D 1.0 and 1.1.
//
// Rows: wavelength m, temperature K, relative humidity %, mu', mu'', eps', eps''; the convention is
// eps' - j eps'' as everywhere here. At each wavelength of the table the row nearest in temperature
// counts (a null fits every temperature), and among equals the first, which has the lowest
// humidity. Between two wavelengths eps' and eps'' are linear in the logarithm of the wavelength;
// up to 10 % outside the table the end row is held, beyond it nothing is made up. Rows without
// wavelength, eps' or eps'' are passed over. A metal's negative eps' becomes 1 where its loss is at
// least a hundred times larger in size: |Gamma| changes by at most 1.3 % at such losses; a negative
// eps' without that loss is no answer. Magnetic media (mu other than 1 by more than 0.01) are no
// answer either: the reflection models here hold for mu = 1.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/errors.h"
#include "materials/dielectric/permittivity.h"
#include "materials/open_material/radar_query.h"

namespace fanbeam::materials {

class PermittivityTable {
 public:
  // Reports E-IO, E-LIMIT (16 MiB, 200000 rows, 32 levels), E-PARSE, E-REF, E-RANGE (values outside
  // the schema, rows out of order, gain instead of loss), E-NONFINITE, E-UNSUPPORTED with file and
  // JSON pointer; the table is then incomplete.
  static PermittivityTable from_file(const std::filesystem::path& file,
                                     core::ProblemList& problems);

  Lookup<Permittivity> at(const RadarQuery& query) const;

 private:
  struct Row {
    double wavelength_m = 0.0;
    std::optional<double> temperature_K;
    bool magnetic = false;
    double real = 1.0, loss = 0.0;
  };
  const Row* nearest(double wavelength_m, double temperature_K) const;

  std::vector<Row> rows_;  // by wavelength
};

}  // namespace fanbeam::materials
