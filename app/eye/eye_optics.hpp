#pragma once
#include "core/problem/probes/probes.hpp"

namespace bulbus::inline eye {

/// Refraction at the cornea of an eye of two thin lenses, D: the vergence of the light that is sharp on the
/// retina, negative for a myopic eye (Holladay, Am. J. Ophthalmology 116, 63, 1993),
///     R = n/(e + n/(n/(L − e) − lens)) − cornea,   n = 1336 D mm
/// `length`: from the cornea's vertex to the retina, `lens_depth`: to the lens, mm; powers in D.
double refraction(double corneal_power, double lens_power, double lens_depth, double length);

/// The kinds of probes of the deformed eye, whose axis is z, for a ProbeSet:
///
///     corneal_power         mean of both principal powers, (1.3375 − 1)/radius, of the front in `set`, D
///     corneal_astigmatism   their difference, not negative, D
///     steep_meridian        where the power is greatest, from +x towards +y
///     refraction            spherical equivalent: cornea `set`, retina's pole `to`, lens `region`, D
ProbeSet::Kinds optical_probes();

}  // namespace bulbus::inline eye
