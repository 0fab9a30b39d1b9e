// Material that moves a surface by its modes and colours it by a field, both in
// the vertex shader. LIMBER_FIELD is the field: there is a shader for each, as a
// renderer by the processor also computes what a shader's branch leaves out.
import * as THREE from 'three';

/// The field that rigid links lack, that which needs modal velocities, and that which only results with stress
/// have.
export const kDeformationField = 1;
export const kVelocityField = 3;
export const kStressField = 4;

/// Fields by which surfaces are coloured; `index` is that of the shader, `without`
/// says why a link may lack it.
export const kFields = [
  { name: 'none', label: 'by link', unit: '', index: 0 },
  { name: 'deformation', label: 'deformation', unit: 'm', index: 1, without: 'rigid' },
  { name: 'displacement', label: 'displacement', unit: 'm', index: 2 },
  { name: 'velocity', label: 'velocity', unit: 'm/s', index: kVelocityField },
  {
    name: 'von_mises', label: 'von Mises stress', unit: 'Pa', index: kStressField,
    without: 'stress not computed',
  },
];

const kDeclarations = /* glsl */ `
uniform float limberMagnification;
uniform vec3 limberVelocity;  // body frame
uniform vec3 limberSpin;      // body frame
uniform mat4 limberBack;      // from the body frame to that of the start
uniform vec2 limberRange;
#ifdef LIMBER_MODES
uniform float limberRates[LIMBER_MODES];
uniform float limberStart[LIMBER_MODES];
#endif
#if LIMBER_FIELD == 4
attribute float limberStress;
#endif
#ifdef LIMBER_DEFORMED  // by the processor
attribute vec3 limberDeformation;  // magnified
attribute vec3 limberDeformationRate;
attribute vec3 limberDeformationStart;
#endif
#if LIMBER_FIELD > 0
varying float limberValue;
#endif
`;

// One fetch of a mode serves the deformation, its rate and that of the start.
const kMotion = /* glsl */ `
vec3 limberX = transformed;
vec3 limberU = vec3(0.0);
vec3 limberUdot = vec3(0.0);
vec3 limberU0 = vec3(0.0);
#ifdef LIMBER_DEFORMED
limberU = limberDeformation;
limberUdot = limberDeformationRate;
limberU0 = limberDeformationStart;
#elif defined(LIMBER_MODES)
int limberRow = gl_VertexID / morphTargetsTextureSize.x;
ivec2 limberTexel = ivec2(gl_VertexID - limberRow * morphTargetsTextureSize.x, limberRow);
for (int i = 0; i < LIMBER_MODES; i++) {
  vec3 shape = texelFetch(morphTargetsTexture, ivec3(limberTexel, i), 0).xyz;
  limberU += shape * morphTargetInfluences[i];
#if LIMBER_FIELD == 2
  limberU0 += shape * limberStart[i];
#elif LIMBER_FIELD == 3
  limberUdot += shape * limberRates[i];
#endif
}
#endif
transformed = limberX + limberU;
limberU /= limberMagnification;
#if LIMBER_FIELD == 1
float limberSize = length(limberU);
#elif LIMBER_FIELD == 2
vec3 limberNow = (limberBack * vec4(limberX + limberU, 1.0)).xyz;
float limberSize = distance(limberNow, limberX + limberU0);
#elif LIMBER_FIELD == 3
float limberSize =
    length(limberVelocity + cross(limberSpin, limberX + limberU) + limberUdot);
#elif LIMBER_FIELD == 4
float limberSize = limberStress;
#endif
#if LIMBER_FIELD > 0
limberValue = (limberSize - limberRange.x) / (limberRange.y - limberRange.x);
#endif
`;

const kColourDeclarations = /* glsl */ `
#if LIMBER_FIELD > 0
uniform sampler2D limberMap;
varying float limberValue;
#endif
`;

const kColour = /* glsl */ `
#if LIMBER_FIELD > 0
diffuseColor.rgb = texture2D(limberMap, vec2(clamp(limberValue, 0.002, 0.998), 0.5)).rgb;
#endif
`;

/// Uniforms that every surface of a page shares.
export function makeSharedUniforms(map) {
  return {
    limberMagnification: { value: 1 },
    limberRange: { value: new THREE.Vector2(0, 1) },
    limberMap: { value: map },
  };
}

/// @param shared makeSharedUniforms(), or null: one colour, such as a ghost's
export function makeMaterial(colour, modes, shared) {
  const material = new THREE.MeshLambertMaterial({
    color: colour,
    flatShading: true,
  });
  const own = {
    limberVelocity: { value: new THREE.Vector3() },
    limberSpin: { value: new THREE.Vector3() },
    limberBack: { value: new THREE.Matrix4() },
  };
  material.defines = { LIMBER_FIELD: 0 };
  if (modes > 0) {
    own.limberRates = { value: new Float32Array(modes) };
    own.limberStart = { value: new Float32Array(modes) };
    material.defines.LIMBER_MODES = modes;
  }
  material.userData.own = own;
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, shared, own);
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', `#include <common>\n${kDeclarations}`)
      .replace('#include <morphtarget_vertex>', kMotion);
    shader.fragmentShader = shader.fragmentShader
      .replace(
        '#include <common>',
        `#include <common>\n${kColourDeclarations}`,
      )
      .replace('#include <color_fragment>', `#include <color_fragment>\n${kColour}`);
  };
  material.customProgramCacheKey = () => 'limber';
  return material;
}
