// Pictures and films of the canvas.
import { drawWithCaption } from './caption.js';

// A film without any frame is not larger [bytes].
const kHeaderOnly = 1000;

export function save(blob, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

function copyShape(canvas) {
  const copy = document.createElement('canvas');
  copy.width = canvas.width;
  copy.height = canvas.height;
  return copy;
}

/// With its caption. @param draw draws the canvas now, so that it still holds the picture
export function takePicture(canvas, draw, caption) {
  const picture = copyShape(canvas);
  draw();
  drawWithCaption(canvas, caption(), picture);
  return new Promise((done) => picture.toBlob(done, 'image/png'));
}

/// Plays the interval once and records it, with the caption of each frame.
/// @param draw, caption as of takePicture
export function takeFilm(canvas, draw, caption, player) {
  // Of the two, VP8 is faster to encode: a busy machine keeps up with it.
  const type = ['video/webm;codecs=vp8', 'video/webm;codecs=vp9', 'video/webm'].find((t) =>
    MediaRecorder.isTypeSupported(t),
  );
  if (!type) return Promise.reject(new Error('this browser records no WebM'));
  const frame = copyShape(canvas);
  const stream = frame.captureStream(0);  // of frames that are asked for
  const [track] = stream.getVideoTracks();
  const drawFrame = () => {
    draw();
    drawWithCaption(canvas, caption(), frame);
    track.requestFrame();
  };
  const recorder = new MediaRecorder(stream, { mimeType: type, videoBitsPerSecond: 8e6 });
  const parts = [];
  recorder.ondataavailable = (event) => parts.push(event.data);
  return new Promise((done, fail) => {
    recorder.onstop = () => {
      const film = new Blob(parts, { type: 'video/webm' });
      if (film.size > kHeaderOnly) done(film);
      else fail(new Error('no frame was recorded; play slower'));
    };
    player.seek(player.from);
    recorder.start();
    drawFrame();
    player.play();
    let last = player.time;
    const watch = () => {
      if (!player.isPlaying || player.time < last) {
        player.pause();
        recorder.stop();
        return;
      }
      last = player.time;
      drawFrame();
      requestAnimationFrame(watch);
    };
    requestAnimationFrame(watch);
  });
}
